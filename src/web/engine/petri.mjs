// petri.mjs: petri sessions for JavaScript, which load a script, step it and read values. petri.d.ts documents types and calls; otherwise
// the contracts of petri.h apply.
import { Archive } from './archive.mjs';
import { callEngine } from './call.mjs';
import { LEVELS, SECTIONS, STATUSES, TOKENS } from './constants.mjs';
import { drawPicture, measureText, needsEngine, pictureSize } from './drawing.mjs';
import { pixelContext, readPixels } from './pixels.mjs';
import { compile, instantiate } from './wasm.mjs';

export { engineFile } from './simd.mjs';

const OTHER_STATUSES = { limit_exceeded: 'limit', out_of_memory: 'memory', unsupported: 'missing' };
export const STATUS = STATUSES.map(name => OTHER_STATUSES[name] ?? name);
const REASONS = {
    invalid: 'invalid argument', limit: 'limit exceeded', memory: 'out of memory', missing: 'not supported', interrupted: 'interrupted',
};
// petri can measure only the engine's stack; JavaScript engines also use a stack of about 1 MiB. This limit allows 500 nested calls of a
// function, and reports deeper recursion before the browser's stack overflows.
const STACK = 768 << 10;
const MEMORY = 1 << 30;
const CALL_WORK = 2 ** 28; // one or two seconds

// Thrown when a call fails; `diagnostics` are the messages of that call. `what` is the task of the call, as in `cannot load
// the script`.
export class PetriError extends Error {
    constructor(status, diagnostics, what) {
        const first = diagnostics.find(one => one.level === 'error') ?? diagnostics[0];
        super(`cannot ${what}: ${first ? first.rendered.trimEnd() : REASONS[status]}`);
        this.name = 'PetriError';
        this.status = status;
        this.diagnostics = diagnostics;
    }
}

// Compiles the engine and returns it. For `source`, see `compile` in wasm.mjs.
export async function loadEngine(source) {
    return new Engine(await compile(source));
}

// All sessions of an engine share its memory, so a crash makes all of them unusable.
class Engine {
    constructor(module) {
        this.module = module;
        this.session = null; // the session of the current call
        this.prompt = null; // the prompt of the page (web_prompt_open)
        this.paint = null; // draws the paint of the current filter (pixels.mjs)
        const text = at => this.memory.text(at);
        const now = () => this.session;
        this.memory = instantiate(module, {
            write: (at, length) => now().written.push(this.memory.text(at, length)),
            should_interrupt: () => (now().mayInterrupt && now().shouldInterrupt?.() ? 1 : 0),
            read: (name, length) => now().readFile(text(name), length),
            diagnostic: (level, file, message, code, hint, rendered, line, column, endLine, endColumn) =>
                now().report({
                    level: LEVELS[level], file: text(file), text: text(message), code: text(code), hint: text(hint),
                    rendered: text(rendered), line, column, endLine, endColumn,
                }),
            frame: (number, time, beat, fps, tempo, steps, evaluationSeconds, physicsSeconds) =>
                now().results.push({ number, time, beat, fps, tempo, steps, evaluationSeconds, physicsSeconds }),
            parameter: (name, defaultValue, value, comment, number, defaultNumber, min, max, step, defined, settable,
                line, column) =>
                now().results.push({
                    name: text(name), defaultValue: text(defaultValue), value: text(value), comment: text(comment), number,
                    defaultNumber, min, max, step, defined: !!defined, settable: !!settable, line, column,
                }),
            system: (name, dimensions, count, forces, steps) =>
                now().results.push({ name: text(name), dimensions, count, forces, steps }),
            column: (name, data, stride) => now().addColumn(text(name), data, stride),
            contribution: (kind, file, line, column, partner, vector, dimensions) =>
                now().results.push({
                    kind: text(kind), file: text(file), line, column, partner: text(partner),
                    vector: Array.from(this.memory.numbers(vector, dimensions)),
                }),
            entry: (key, numbers, length, mixed) =>
                now().results.push({
                    key: text(key),
                    value: numbers ? Array.from(this.memory.numbers(numbers, length)) : text(mixed),
                }),
            picture: (numbers, count, title, ready) =>
                now().results.push({ numbers: this.memory.numbers(numbers, count).slice(), title: text(title), ready: !!ready }),
            gl_ready: () => this.memory.screen.ready,
            gl_has: name => this.memory.screen.extensions.has(text(name)),
            screen: (width, height) => this.memory.screen.resize(width, height),
            shown: (title, ready) => now().results.push({ image: this.memory.screen.take(), title: text(title), ready: !!ready }),
            draw: (numbers, count, width, height, pixels) => now().drawCanvas(numbers, count, width, height, pixels),
            measure: (words, family, ...style) => measureText(text(words), text(family), ...style),
            image: (name, width, height) => now().imagePixels(text(name), width, height),
            paint: (commands, count, pixels) => this.paint(this.memory.numbers(commands, count).slice(), pixels),
            archive: (script, command, version, sha256, firstFrame, lastFrame) =>
                now().results.push({
                    script: text(script), command: text(command), version: text(version), sha256: text(sha256), firstFrame, lastFrame,
                }),
            archived_file: (name, frame, at, length) =>
                now().results.push({ name: text(name), frame, bytes: this.memory.bytes().slice(at, at + length) }),
            prompt: (act, frame, name, value) => now().actForPrompt(text(act), ...name ? [text(name), text(value)] : [frame]),
            move: (system, particle, dimensions, ...vectors) =>
                now().actForPrompt('move', system, particle, ...vectors.map(at => (at ? [...this.memory.numbers(at, dimensions)] : null))),
            matches: (pattern, string) => (new RegExp(text(pattern)).test(text(string)) ? 1 : 0),
            token: (kind, start, end) => now().results.push({ kind: TOKENS[kind], start, end }),
            help: (kind, name, parameters, defaultValue, unit, help) =>
                now().results.push({
                    kind: text(kind), name: text(name), parameters: text(parameters), defaultValue: text(defaultValue),
                    unit: text(unit), help: text(help),
                }),
        });
    }

    get version() {
        return this.memory.text(this.memory.wasm.petri_version());
    }

    // Sets a function that is called with true after the WebGL context was lost, and with false after the browser has restored it.
    set onContextChange(changed) {
        this.memory.screen.onContextChange = changed;
    }

    open(options = {}) {
        return new Session(this, options);
    }

    openArchive(bytes, { memory = MEMORY } = {}) {
        if (!this.memory.wasm.web_archive_open)
            throw new Error('this engine has no archives; load engine-archives.wasm');
        return new Archive(this, bytes, memory);
    }
}

export class Session {
    constructor(engine,
        {
            fps = 0, memory = MEMORY, work = CALL_WORK, keepForces = false, files = {}, archive = null, image = () => null,
            onDiagnostic, shouldInterrupt,
        } = {}) {
        this.engine = engine;
        this.memory = engine.memory;
        this.onDiagnostic = onDiagnostic;
        this.shouldInterrupt = shouldInterrupt;
        this.image = image;
        this.archive = archive;
        this.painter = null; // null: not opened yet; 0: not available
        this.renders = null; // true if the painter has a WebGL context; null: not tried yet
        this.context = 0; // the WebGL context of the painter (Screen.context)
        this.followed = null; // the last rendered picture, if later pictures depend on it
        this.unsupported = new Set();
        this.files = new Map();
        this.kept = []; // addresses of file contents, freed when the session is closed
        this.written = [];
        this.results = [];
        this.reported = [];
        for (const [name, content] of Object.entries(files))
            this.setFile(name, content);
        this.handle = this.run(wasm => wasm.web_open(fps, memory, work, STACK, keepForces ? 1 : 0, archive?.handle ?? 0));
        if (!this.handle)
            throw new RangeError('cannot open a session: out of memory or invalid options');
    }

    close() {
        this.closePainter();
        if (this.handle)
            this.run(wasm => wasm.web_close(this.handle));
        this.handle = 0;
        [...this.kept, this.pixels ?? 0].forEach(at => this.memory.wasm.free(at));
        this.pixels = 0;
        this.kept = [];
    }

    // Adds a file, given as a string or bytes, that scripts can read or import. null removes the file.
    setFile(name, content) {
        if (content === null)
            this.files.delete(name);
        else
            this.files.set(name, { bytes: typeof content === 'string' ? new TextEncoder().encode(content) : content, at: 0 });
    }

    run(act, mayInterrupt = false) {
        return callEngine(this, act, mayInterrupt);
    }

    // Like run, for calls that return a status. Throws a PetriError unless the status is 'ok'.
    check(what, act) {
        const status = STATUS[this.run(act, true)];
        if (status !== 'ok') {
            const { reported } = this, problem = status === 'invalid' ? this.archive?.problem : null;
            throw new PetriError(status, problem ? [{ level: 'error', rendered: problem }] : reported, what);
        }
        return this;
    }

    with(text, act) {
        return wasm => this.memory.withText(text, (at, length) => act(wasm, at, length));
    }

    load(text, name = 'script.fl') {
        this.closePainter();
        this.servePainter();
        const encoded = typeof text === 'string' ? new TextEncoder().encode(text) : text;
        this.setFile(name, encoded);
        return this.check('load the script', this.with(name, (wasm, called) =>
            this.memory.withText(encoded, (at, length) => wasm.petri_load_text(this.handle, called, at, length))));
    }

    // Replaces the script; frame numbers, time and state continue.
    reload(text, name = 'script.fl') {
        this.setFile(name, text);
        return this.check('reload the script', this.with(name, (wasm, called) => wasm.petri_reload(this.handle, called)));
    }

    // Returns the diagnostics of a script without changing anything.
    diagnose(text, name = 'script.fl') {
        const status = STATUS[this.run(this.with(name, (wasm, called) =>
            this.memory.withText(text, (at, length) => wasm.petri_check_text(this.handle, called, at, length))), true)];
        if (status === 'interrupted')
            throw new PetriError(status, this.reported, 'check the script');
        return this.reported;
    }

    // Defines a name, as in 'SIZE=20', for scripts loaded from now on.
    define(definition) {
        return this.check(`define ${definition}`, this.with(definition, (wasm, at) => wasm.petri_define(this.handle, at)));
    }

    step() {
        return this.check('compute the frame', wasm => wasm.petri_step(this.handle));
    }

    stepAt(time, beat) {
        return this.check('compute the frame', wasm => wasm.petri_step_at(this.handle, time, beat));
    }

    clear() {
        this.run(wasm => wasm.petri_reset(this.handle));
    }

    get frame() {
        this.run(wasm => wasm.web_frame(this.handle));
        return this.results[0];
    }

    // The units of work of all calls since the session was opened.
    get work() {
        return this.run(wasm => wasm.web_work(this.handle));
    }

    // Returns the text of the last frame, with sections as in `petri run --print`.
    print(...sections) {
        const bits = sections.reduce((sum, name) => sum | SECTIONS[name], 0);
        this.check('print the frame', wasm => wasm.web_print(this.handle, bits));
        return this.written.join('');
    }

    log() {
        this.run(wasm => wasm.web_log(this.handle));
        return this.written.join('');
    }

    // Returns the particles of the last frame as rows of a table, as in `petri run --trajectory`. `dimensions` is the number that the first
    // call returned, or 0 to include a header.
    table(dimensions = 0) {
        const has = this.run(wasm => wasm.web_particles(this.handle, dimensions), true);
        if (has <= 0)
            throw new PetriError(has ? 'interrupted' : 'memory', this.reported, 'write the particles');
        return { text: this.written.join(''), dimensions: has };
    }

    // Returns the digest of the state.
    digest() {
        return this.print('digest').match(/[0-9a-f]{32}/)[0];
    }

    // Returns the SHA-256 of the printed state.
    hash() {
        return this.print('hash').match(/[0-9a-f]{64}/)[0];
    }

    get parameters() {
        this.run(wasm => wasm.web_parameters(this.handle));
        return this.results;
    }

    // Sets a parameter. `value` has the form that it has in a script; null means the default.
    setParameter(name, value) {
        const set = (wasm, at) => value === null
            ? wasm.petri_set_parameter(this.handle, at, 0)
            : this.memory.withText(String(value), text => wasm.petri_set_parameter(this.handle, at, text));
        return this.check(`set the parameter ${name}`, this.with(name, set));
    }

    // The systems of the last frame. Columns are views of the engine's memory, valid until the next call that changes the session. The
    // numbers of particle i begin at i * stride.
    get systems() {
        this.run(wasm => wasm.web_systems(this.handle));
        return this.results;
    }

    // Returns the id of a particle as it is printed, such as "7"; null if there is no such particle.
    particleId(system, particle) {
        return this.run(wasm => wasm.web_particle_id(this.handle, system, particle)) ? this.written.join('') : null;
    }

    // Returns the contributions to the force on a particle in the last step of the frame, and their sum.
    explain(system, particle) {
        this.check('explain the force', wasm => wasm.web_explain(this.handle, system, particle));
        const contributions = this.results.slice(0, -1);
        return { contributions, sum: this.results.at(-1).value };
    }

    // Returns the particle at a point of the picture as { name, id }: the name of its system and its id, as they are printed; null if there
    // is none. x and y are 0 at the top left and 1 at the bottom right.
    pick(x, y, { automatic = false } = {}) {
        return this.run(wasm => wasm.web_pick(this.handle, automatic ? 1 : 0, x, y))
            ? { name: this.results[0].key, id: this.results[0].value } : null;
    }

    // Describes a particle of the last frame, given as by `pick`: entries of the state, the node that makes it, and the contributions to
    // the force on it, as by `explain`. `note` is the reason why something is missing.
    describe({ name, id }) {
        this.check('explain the force', this.with(name, (wasm, at) =>
            this.memory.withText(id, text => wasm.web_describe(this.handle, at, text))));
        const { results } = this, entries = new Map(results.filter(({ key }) => key).map(({ key, value }) => [key, value]));
        const { sum, note, ...state } = Object.fromEntries(entries);
        return {
            origin: results.find(({ vector }) => vector?.length === 0), contributions: results.filter(({ vector }) => vector?.length),
            state: Object.entries(state), sum, note,
        };
    }

    addColumn(name, data, stride) {
        const system = this.results.at(-1), width = name === 'position' || name === 'velocity' ? system.dimensions : 1;
        system[name] = data && system.count
            ? { data: this.memory.numbers(data, (system.count - 1) * stride + width), stride }
            : null;
    }

    // The state: a map from printed keys to arrays of numbers, or to the printed value if not all elements are numbers.
    get state() {
        this.run(wasm => wasm.web_state(this.handle));
        return new Map(this.results.map(entry => [entry.key, entry.value]));
    }

    // Sets a global, one or more numbers, for scripts that are loaded later. Its value can be changed at any time.
    setGlobal(name, value) {
        const numbers = Float64Array.from(typeof value === 'number' ? [value] : value);
        return this.check(`set the global ${name}`, this.with(name, (wasm, called) =>
            this.memory.withText(new Uint8Array(numbers.buffer), at =>
                wasm.web_set_global(this.handle, called, numbers.length ? at : 0, numbers.length))));
    }

    // Evaluates an expression in the last frame.
    evaluate(expression) {
        this.check('evaluate the expression', this.with(expression, (wasm, at, length) => wasm.web_evaluate(this.handle, at, length)));
        if (this.reported.some(one => one.level === 'error'))
            throw new PetriError('invalid', this.reported, 'evaluate the expression');
        return { text: this.written.join(''), number: this.results[0].value[0] };
    }

    // Evaluates a line typed at the prompt and returns its output.
    prompt(text) {
        this.check('evaluate the line', this.with(text, (wasm, at, length) => wasm.web_prompt(this.handle, at, length)));
        return this.written.join('');
    }

    // Executes an input of the prompt as `petri repl` does: a command or code. `host` has `first` and `last`, the bounds of the timeline,
    // and moves the session: step(), goTo(frame), set(name, value), move(system, particle, position, velocity), see History.move. run() and
    // plot(expression) are requests of the input.
    execute(text, host) {
        const { engine } = this;
        this.host = host;
        engine.prompt ??= this.run(wasm => wasm.web_prompt_open());
        const done = this.run(this.with(text, (wasm, at, length) =>
            wasm.web_prompt_execute(engine.prompt, this.handle, host.first, host.last, at, length)), true);
        return { text: this.written.join(''), failed: !done };
    }

    // Calls a function of the prompt's host, which can call the engine. Returns the status.
    actForPrompt(act, ...given) {
        const { mayInterrupt, reported, written, results } = this;
        try {
            this.host[act](...given);
            return 0;
        } catch (error) {
            return Math.max(STATUS.indexOf(error.status), 1);
        } finally {
            Object.assign(this, { mayInterrupt, reported, written, results });
        }
    }

    // Removes the nodes that were typed at the prompt and, if `bindings` is true, also the names. Returns the number of statements.
    clearPrompt(bindings = false) {
        return this.run(wasm => wasm.petri_prompt_clear(this.handle, bindings ? 1 : 0));
    }

    // The display list of the last frame, for drawing.mjs; null if there is nothing to draw.
    displayList({ automatic = false } = {}) {
        this.run(wasm => wasm.web_picture(this.handle, 0, 0, automatic ? 1 : 0));
        return this.results[0] ?? null;
    }

    // True if the picture of the last frame depends on earlier pictures. `renderIfNeeded` must then be called after every step.
    get needsHistory() {
        return !!this.run(wasm => wasm.petri_needs_history(this.handle));
    }

    // If later pictures depend on the last frame, renders this frame without showing it and returns true. Also updates the visible region
    // of the automatic picture.
    renderIfNeeded() {
        this.run(wasm => wasm.web_follow_frame(this.handle));
        if (!this.needsHistory)
            return false;
        const { number } = this.frame;
        if (this.followed?.number !== number && this.openPainter()) {
            this.forgetPicture();
            this.followed = { number, at: this.run(wasm => wasm.web_render_if_needed(this.handle, this.painter)) };
        }
        return true;
    }

    // Opens the painter, with which scripts measure texts and sample pictures, in browsers only: Node.js has no fonts.
    servePainter() {
        if (typeof OffscreenCanvas !== 'undefined')
            this.painter ??= this.run(wasm => wasm.web_painter(this.handle));
    }

    // Returns the painter, or 0 if there is no WebGL context. After the context was lost or restored, replaces the painter.
    openPainter() {
        const { context } = this.memory.screen;
        if (context !== this.context && this.renders !== null)
            this.closePainter();
        this.context = context;
        this.servePainter();
        this.renders ??= !!this.painter && !!context && !!this.run(wasm => wasm.web_painter_use_gl(this.painter));
        return this.renders ? this.painter : 0;
    }

    forgetPicture() {
        if (this.followed)
            this.run(wasm => wasm.web_picture_free(this.followed.at));
        this.followed = null;
    }

    closePainter() {
        this.forgetPicture();
        if (this.painter)
            this.run(wasm => wasm.web_painter_close(this.painter, this.handle));
        this.painter = this.renders = null;
    }

    // Like displayList, but renders content that needs WebGL 2 to an image, if WebGL 2 is available.
    render({ automatic = false } = {}) {
        const painter = this.openPainter();
        this.unsupported.clear();
        const followed = this.renderIfNeeded() && !automatic ? this.followed?.at ?? 0 : 0;
        this.run(wasm => wasm.web_picture(this.handle, painter, followed, automatic ? 1 : 0));
        const shown = this.results[0] ?? null, { lost } = this.memory.screen;
        if (painter && lost) // the context was lost while the picture was drawn
            return this.render({ automatic });
        if (shown?.numbers && needsEngine(shown.numbers) && typeof OffscreenCanvas !== 'undefined')
            this.drawList(shown);
        return shown && { ...shown, screen: painter > 0, lost, ...(shown.image && { unsupported: [...this.unsupported] }) };
    }

    // Replaces a display list by an image.
    drawList(shown) {
        const { width, height } = pictureSize(shown.numbers), canvas = new OffscreenCanvas(width, height);
        const unsupported = drawPicture(canvas.getContext('2d'), shown.numbers, { image: this.image, engine: this.engine });
        unsupported.forEach(what => this.unsupported.add(what));
        shown.image = canvas.transferToImageBitmap();
        delete shown.numbers;
    }

    drawCanvas(numbers, count, width, height, pixels) {
        const context = pixelContext(width, height), { image, engine } = this;
        // The list is copied, because its memory moves when the engine's memory grows.
        const unsupported = drawPicture(context, this.memory.numbers(numbers, count).slice(), { image, engine, background: null });
        unsupported.forEach(what => this.unsupported.add(what));
        readPixels(this.memory, context, pixels);
        return true;
    }

    // Returns the address of an image's pixels, valid until the next image is requested.
    imagePixels(name, width, height) {
        const image = this.image(name);
        this.memory.wasm.free(this.pixels ?? 0);
        this.pixels = image ? this.memory.wasm.malloc(4 * image.width * image.height) : 0;
        if (!this.pixels)
            return 0;
        const context = pixelContext(image.width, image.height);
        context.reset();
        context.drawImage(image, 0, 0);
        readPixels(this.memory, context, this.pixels);
        this.memory.setWord(width, image.width);
        this.memory.setWord(height, image.height);
        return this.pixels;
    }

    get drawable() {
        return !!this.run(wasm => wasm.petri_has_picture(this.handle));
    }

    tokens(text) {
        this.run(this.with(text, (wasm, at, length) => wasm.web_tokens(this.handle, at, length)));
        return this.results;
    }

    // Returns the rows of petri's tables: functions; nodes, each followed by its attributes; names bound in the script.
    help() {
        this.run(wasm => wasm.web_help(this.handle));
        return this.results;
    }

    symbol(name) {
        return this.run(this.with(name, (wasm, at) => wasm.petri_symbol(this.handle, at)));
    }

    symbolName(number) {
        return this.run(wasm => wasm.web_symbol_name(this.handle, number)) ? this.written.join('') : null;
    }

    pointer(inside, x = 0, y = 0, buttons = 0) {
        return this.check('report the pointer', wasm => wasm.web_pointer(this.handle, inside ? 1 : 0, x, y, buttons));
    }

    key(name, pressed) {
        return this.check(`report the key ${name}`, this.with(name, (wasm, at) =>
            wasm.petri_report_key(this.handle, at, pressed ? 1 : 0)));
    }

    // Returns a snapshot of the complete state of the session. It must be freed before the session is closed.
    snapshot() {
        const at = this.run(wasm => wasm.petri_snapshot(this.handle));
        if (!at)
            throw new PetriError('memory', this.reported, 'take a snapshot');
        return new Snapshot(this, at);
    }

    // Restores a snapshot. Pictures that depend on earlier pictures start again.
    rewind(snapshot) {
        this.closePainter();
        this.servePainter();
        return this.check('restore the snapshot', wasm => wasm.petri_rewind(this.handle, snapshot.at));
    }

    // Returns a history, which keeps the frames that its `step` computes, to go back to them.
    history(bytes = 0) {
        return new History(this, bytes);
    }

    report(diagnostic) {
        this.reported.push(diagnostic);
        this.onDiagnostic?.(diagnostic);
    }

    // For `glob`, a folder is a file that contains the names in the folder, one per line.
    listFolder(prefix, name) {
        const below = [...this.files.keys()].filter(file => file.startsWith(prefix) && !file.endsWith('/'));
        const names = new Set(below.map(file => file.slice(prefix.length).replace(/\/.*/, '/')));
        const text = [...names].join('\n');
        if (this.files.get(name)?.text !== text && (text || !prefix))
            this.files.set(name, { text, bytes: new TextEncoder().encode(text), at: 0 });
    }

    readFile(name, length) {
        if (name.endsWith('/'))
            this.listFolder(name === './' ? '' : name, name);
        const file = this.files.get(name);
        if (!file)
            return 0;
        if (!file.at) {
            file.at = this.memory.keep(file.bytes);
            this.kept.push(file.at);
        }
        this.memory.setWord(length, file.bytes.length);
        return file.at;
    }
}

class Snapshot {
    constructor(session, at) {
        this.session = session;
        this.at = at;
        this.bytes = session.run(wasm => wasm.petri_snapshot_bytes(at));
    }

    free() {
        if (this.at)
            this.session.run(wasm => wasm.petri_snapshot_free(this.at));
        this.at = 0;
    }
}

// A timeline of frames (petri_history_new). It must be freed before the session is closed.
class History {
    constructor(session, bytes) {
        this.session = session;
        this.at = session.run(wasm => wasm.petri_history_new(session.handle, bytes));
        if (!this.at)
            throw new PetriError('memory', session.reported, 'keep the history');
    }

    // Starts again at the current frame.
    start() {
        return this.session.check('keep the history', wasm => wasm.petri_history_start(this.at, 0));
    }

    // Like Session.step. Steps from a past frame repeat the changes of parameters and of the script.
    step() {
        return this.session.check('compute the frame', wasm => wasm.petri_history_step(this.at));
    }

    // Moves a particle of the current frame, given by the numbers of its system and of the particle in it. Vectors are arrays; one that is
    // missing is kept. Frames after this one are discarded.
    move(system, particle, position, velocity) {
        const { session } = this, copied = (vector, use) =>
            vector ? session.memory.withText(new Uint8Array(Float64Array.from(vector).buffer), use) : use(0);
        return session.check('move the particle', wasm => copied(position, first => copied(velocity, second =>
            wasm.petri_history_move_particle(this.at, system, particle, first, second))));
    }

    // Goes to a frame before `frame`, from which few steps lead to it. Returns false if there is none. Pictures that depend on earlier
    // pictures start again.
    rewind(frame) {
        this.session.closePainter();
        this.session.servePainter();
        return STATUS[this.session.run(wasm => wasm.petri_history_rewind(this.at, BigInt(frame)))] === 'ok';
    }

    free() {
        if (this.at)
            this.session.run(wasm => wasm.petri_history_free(this.at));
        this.at = 0;
    }
}

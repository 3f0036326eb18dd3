// dish.mjs: loads a script, runs it on a canvas, and goes to frames. Used by the page and by <petri-dish>.
import { Remote } from './engine.mjs';
import { addImage, paint, sizeOf } from './paint.mjs';
import { Input } from './input.mjs';
import { FIRST_SEEN } from './player.mjs';
import { Rate } from './rate.mjs';

const MAX_STEPS = 8; // maximum number of frames between two pictures; a script that would need more runs in slow motion
const SLOW_PICTURE = 50; // ms for frames and a picture after which every frame has a picture
const SLOW = 500; // ms after which the page offers to stop the computation
const NO_ENGINE = 'petri needs WebAssembly, which this browser does not support or does not allow.';

export class Dish {
    // host: the callbacks shown(answer, unsupported), failed(error, diagnostics) and changed(), which is called when the script starts or
    // stops running; optionally loaded(), slow(boolean) and restored(), which is called if the picture is complete again because the WebGL
    // context was restored.
    constructor(canvas, host, { source, worker }) {
        Object.assign(this, {
            canvas, host, running: false, loaded: null, name: null, frame: -1, lastFrame: -1, fps: 60, speed: 1, behind: 0, last: 0,
            turn: 0, incomplete: false, replays: false, files: new Map(), images: new Map(),
            wanted: null, rate: new Rate(),
        });
        this.remote = globalThis.WebAssembly ? new Remote(source, worker) : null;
        if (this.remote)
            this.remote.onContextChange = lost => this.changeContext(lost);
    }

    // True if the script asks for a node such as !pointer. The modules that it imports are not searched.
    asksFor(node) {
        return new RegExp(`!${node}\\b`).test(this.loaded ?? '');
    }

    get ready() {
        return this.remote?.ready ?? Promise.reject(new Error(NO_ENGINE));
    }

    ask(act, message) {
        return this.remote?.ask(act, message) ?? Promise.reject(new Error(NO_ENGINE));
    }

    // Sends a request to the engine and returns the answer. On failure, reports the error to the host and returns null. With `harmless`,
    // the script still runs after a request that the engine rejected.
    async attempt(act, message, harmless = false) {
        const slow = setTimeout(() => this.host.slow?.(true), SLOW);
        try {
            return await this.ask(act, message);
        } catch (error) {
            await this.fail(error, harmless && error.type === 'failed');
            return null;
        } finally {
            clearTimeout(slow);
            this.host.slow?.(false);
        }
    }

    async fail(error, goesOn = false) {
        this.running &&= goesOn;
        const seen = new Set(), reported = [...(error.diagnostics ?? []), ...(error.reported ?? [])];
        this.host.failed(error, reported.filter(({ rendered }) => !seen.has(rendered) && seen.add(rendered)));
        if (error.type === 'broken')
            await this.restart();
        this.host.changed();
    }

    async restart() {
        this.running = false;
        this.loaded = null;
        this.remote.restart();
        await this.giveFiles();
        this.host.changed();
    }

    // --- pictures

    // Draws a picture and returns descriptions of its unsupported parts. If the script draws nothing, clears the canvas.
    draw({ picture, drawable = !!picture }) {
        this.draws = drawable;
        if (!drawable && this.canvas)
            this.canvas.width = this.canvas.width; // eslint-disable-line no-self-assign -- clears the canvas
        if (!picture)
            return [];
        const { canvas } = this, { width, height } = sizeOf(picture);
        if (canvas.width !== width || canvas.height !== height) {
            Object.assign(canvas, { width, height });
            canvas.style.setProperty('--ratio', width / height);
        }
        return paint(canvas.getContext('2d'), picture, this.images);
    }

    show(answer) {
        Object.assign(this, { frame: answer.frame, lastFrame: answer.lastFrame, fps: answer.fps, parameters: answer.parameters });
        const left = this.draw(answer);
        // A finger on the picture scrolls the page, unless the script asks for the pointer.
        if (this.canvas && this.listened !== this.loaded)
            this.canvas.style.touchAction = this.asksFor('pointer') ? 'none' : '';
        this.listened = this.loaded;
        this.incomplete ||= left.length > 0 && answer.picture.lost;
        this.host.shown(answer, left);
        if (left.includes('canvas3d'))
            this.attempt('automatic').then(other => other?.picture && this.draw(other));
        this.host.changed();
    }

    // Draws the current frame again after the WebGL context was lost or restored.
    changeContext(lost) {
        if (!lost && this.incomplete)
            this.host.restored?.();
        this.incomplete &&= lost;
        if (this.loaded !== null)
            this.showAnswer('shown');
    }

    async showAnswer(act, message) {
        const answer = await this.attempt(act, message);
        if (answer)
            this.show(answer);
        return answer;
    }

    // --- running

    async load(text, name, changes = []) {
        this.running = false;
        const answer = await this.attempt('load', { text, name, changes });
        if (!answer)
            return false;
        Object.assign(this, { loaded: text, name, incomplete: false, replays: false });
        this.host.loaded?.();
        this.show(answer);
        return true;
    }

    // Takes over a changed script: state, frame number and clocks continue. Returns false if it has errors: then, the last script is kept.
    async edit(text, name) {
        if (this.loaded === null || this.replays)
            return this.load(text, name);
        const answer = await this.attempt('edit', { text, name: this.name, again: !this.running });
        if (!answer) {
            if (this.frame <= FIRST_SEEN) // the script was loaded from scratch
                this.loaded = null;
            return false;
        }
        if (answer.applied)
            this.loaded = text;
        this.host.checked?.(answer);
        if (answer.type === 'frame')
            this.show(answer);
        return !!answer.applied;
    }

    // Shows an empty picture until a script is loaded.
    unload() {
        Object.assign(this, { running: false, loaded: null, frame: -1, lastFrame: -1 });
        this.draw({});
        this.host.changed();
    }

    // Replays an archive, and returns its script, or null on failure.
    async replay(bytes) {
        this.running = false;
        const answer = await this.attempt('archive', { bytes });
        if (!answer)
            return null;
        const { text, name } = answer.script;
        Object.assign(this, { loaded: text, name, incomplete: false, replays: true });
        this.host.loaded?.();
        this.show(answer);
        return answer.script;
    }

    // Loads a script and goes to a frame. Returns null on failure. On success, returns an object: `digest` is the digest of the state, or
    // its hash, if the argument with the same name is not null; `same` is true if it equals the argument.
    async open(text, name, { changes = [], frame = 0, digest = null, hash = null } = {}) {
        if (!await this.load(text, name, changes))
            return null;
        const expected = digest ?? hash;
        const shown = await this.showAnswer('seek', { frame: frame || (expected ? 0 : FIRST_SEEN), limited: true });
        if (shown?.limit)
            await this.fail(new Error(`Stopped after frame ${shown.frame}: opening exceeded the limit of ${shown.limit} units of work.`));
        if (!shown || shown.limit)
            return null;
        const answer = expected && await this.attempt(digest ? 'digest' : 'hash'), own = answer && (answer.digest ?? answer.hash);
        return { digest: own, same: own === expected };
    }

    run() {
        if (this.running || this.loaded === null)
            return;
        const turn = ++this.turn;
        Object.assign(this, { running: true, last: performance.now(), behind: 0, took: 0 });
        this.rate.begin();
        this.host.changed();
        requestAnimationFrame(now => this.tick(now, turn));
    }

    pause() {
        this.running = false;
        this.host.changed();
    }

    // Runs at the display rate. Each tick computes the frames that have become due since the last tick, or one frame if computing and
    // drawing takes long. The engine may compute fewer, and the script then runs in slow motion. After a pause, running starts a new turn,
    // and ticks of the previous turn do nothing.
    async tick(now, turn) {
        if (!this.running || turn !== this.turn)
            return;
        this.behind = Math.min(this.behind + Math.max(now - this.last, 0) / 1000 * this.fps * this.speed, MAX_STEPS);
        this.last = now;
        const count = this.took > SLOW_PICTURE ? Math.min(Math.floor(this.behind), 1) : Math.floor(this.behind), before = this.frame;
        this.behind -= count;
        if (count > 0) {
            const answer = await this.showAnswer('step', { count }), end = performance.now();
            this.took = end - now;
            if (this.frame - before < count || this.took > SLOW_PICTURE)
                this.behind = Math.min(this.behind, 1);
            if (answer && this.running && turn === this.turn)
                this.host.ran?.(this.rate.see(end, this.frame));
        }
        requestAnimationFrame(later => this.tick(later, turn));
    }

    async step() {
        this.running = false;
        await this.showAnswer('step', { count: 1 });
    }

    // Pauses and goes to a frame. Sends one request at a time: while the user drags the slider, only its latest position is requested.
    async seek(frame) {
        this.running = false;
        const waits = this.wanted !== null;
        this.wanted = Math.max(frame, 0);
        if (waits)
            return;
        for (let at = null; this.wanted !== at;) {
            at = this.wanted;
            await this.showAnswer('seek', { frame: at });
        }
        this.wanted = null;
    }

    // Sets a parameter. Returns false if the script does not accept the value, which is then reported and changes nothing.
    async set(name, value) {
        const answer = await this.attempt('set', { name, value }, true);
        if (answer && !this.running)
            this.show(answer);
        return !!answer;
    }

    // Interrupts the engine's current call and returns true. If this fails, restarts the engine and returns false.
    async stop() {
        const busy = this.remote?.busy;
        this.pause();
        const alone = !busy || await this.remote.stop();
        if (!alone)
            await this.restart();
        else if (busy && this.loaded !== null)
            await this.showAnswer('shown');
        return alone;
    }

    end() {
        this.running = false;
        this.remote?.end();
    }

    // --- files and input

    // Adds a file. Scripts can read only added files.
    async addFile(name, bytes) {
        this.files.set(name, bytes);
        await addImage(this.images, name, bytes);
    }

    giveFiles() {
        return this.attempt('files', { files: Object.fromEntries(this.files) });
    }

    // Reports the pointer and, while the picture has the focus, keys to the script.
    listen() {
        new Input(this);
    }
}

// Returns the message for the user about an error.
export const errorText = error => error.type === 'stopped' ? 'Stopped. The previous frame is shown.'
    : error.type === 'ended' ? 'Stopped. Press Run to restart.'
        : error.type === 'broken' ? `${error.message}. Press Run to restart.` : error.message.split('\n')[0];

// Returns the message for the user about unsupported parts of a picture.
export const unsupportedText = ({ picture }, left) => picture.lost
    ? `The WebGL context was lost; until the browser restores it or you reload the page, these nodes are not drawn: ${left.join(', ')}.`
    : `Not drawn: ${left.join(', ')}.${picture.screen ? '' : ' This browser does not support WebGL 2.'}`;

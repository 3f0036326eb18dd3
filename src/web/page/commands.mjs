// commands.mjs: the commands of the prompt, which are those of `petri repl`, in the worker.
//
// A command is [name, operands, help, function, required operand]; the first three are as in the tables of `petri repl`. A function gets
// the player, the operand and a context, and returns the text to print. It sets `context.moved` if the page must show another frame.

const MAX_FRAMES = 1e5; // frames that a command computes without --limit
const MAX_LINES = 200; // lines of .state, .tree and .particles without a number

const problem = text => Object.assign(new Error(text), { isMessage: true });
const plural = (count, word) => `${count} ${word}${count === 1 ? '' : 's'}`;

// Returns rows as lines with aligned columns.
function columns(rows) {
    const widths = rows[0].map((_, i) => Math.max(...rows.map(row => [...row[i]].length)));
    return rows.map(row => `${row.map((cell, i) => cell + ' '.repeat(widths[i] - [...cell].length)).join('  ').trimEnd()}\n`).join('');
}

const frameLine = ({ session }) => `@${session.frame.number} time=${session.frame.time} beat=${session.frame.beat}\n`;

function number(player, text, { min = -Infinity, whole = false } = {}) {
    const value = player.session.evaluate(text).number;
    if (!Number.isFinite(value) || value < min || (whole && !Number.isInteger(value)))
        throw problem(`not ${whole ? `an integer >= ${min}` : 'a number'}: '${text}'`);
    return value;
}

// Splits a last operand `all` or N from a text, and returns the rest and the maximum number of lines.
function withCount(text) {
    const [, rest, count] = text.match(/^(.*?)(?:(?:^|\s+)(all|[1-9]\d*))?$/s);
    return [rest.trim(), count === 'all' ? Infinity : Number(count ?? MAX_LINES)];
}

function someLines(lines, max, command) {
    const more = lines.length - max;
    return lines.slice(0, max).join('') + (more > 0 ? `-- ${more} more lines; '${command} all' shows all lines\n` : '');
}

// Computes frames until `ends` returns true; at most `count`. Returns true if it did.
async function advance(player, context, count, ends = () => false) {
    const from = player.frame;
    context.moved = true;
    for (let i = 0; i < count; i++) {
        if (context.shouldInterrupt())
            throw problem(`interrupted after ${plural(i, 'frame')}`);
        player.step();
        if (ends())
            return player.frame - from;
    }
    return 0;
}

async function step(player, text, context) {
    await advance(player, context, text ? number(player, text, { min: 1, whole: true }) : 1);
    return frameLine(player);
}

async function run(player, text, context) {
    if (!text) {
        context.runs = true;
        return '';
    }
    const seconds = number(player, text);
    if (seconds < 0)
        throw problem(`not a time: '${text}'; use seconds`);
    await advance(player, context, Math.ceil(seconds * player.session.frame.fps - 1e-9));
    return frameLine(player);
}

async function until(player, text, context) {
    const [, expression, limit] = text.match(/^(.*?)(?:\s+--limit\s+(\S+))?$/s);
    const isTrue = () => !['false', 'null', '0'].includes(player.session.evaluate(`1 if (${expression}) else 0`).text);
    isTrue(); // reports errors in the expression before the first step
    const max = limit ? number(player, limit, { min: 1, whole: true }) : MAX_FRAMES;
    const reached = await advance(player, context, max, isTrue);
    return frameLine(player)
        + (reached ? '' : `the condition was not true within ${plural(max, 'frame')}; --limit sets this maximum\n`);
}

function goTo(player, frame, context) {
    if (frame < player.first)
        throw problem(`the first frame is ${player.first}`);
    context.moved = true;
    while (!player.seek(frame, 1))
        if (context.shouldInterrupt())
            throw problem(`interrupted in frame ${player.frame}`);
    return frameLine(player);
}

function back(player, text, context) {
    const count = text ? number(player, text, { min: 1, whole: true }) : 1, ago = player.frame - player.first;
    if (ago < 1)
        throw problem('cannot go back: this is the start');
    const note = count > ago ? `-- went back only ${plural(ago, 'frame')}: this is the start\n` : '';
    return note + goTo(player, player.frame - Math.min(count, ago), context);
}

// Selects the entries whose key is `wanted` or begins with it: `:cells` and `cells` select both `$:cells` and `$(:cells;0)`.
function state({ session }, text) {
    const isKey = /^\d+$/.test(text); // a number alone is a key
    const [asked, max] = isKey ? [text, MAX_LINES] : withCount(text), key = asked.replace(/^\$?\(?/, '').replace(/\)$/, '');
    const lines = session.print('state').split(/(?<=\n)/).slice(1).filter(line => {
        const own = line.slice(line[1] === '(' ? 2 : 1), name = own.startsWith(':') && !key.startsWith(':') ? own.slice(1) : own;
        return !key || (name.startsWith(key) && ';) '.includes(name[key.length]));
    });
    return lines.length ? someLines(lines, max, `.state ${asked}`.trim())
        : `-- the state ${key ? `has no entry under ${key}` : 'is empty'}\n`;
}

// Selects the nodes of a kind with their children.
function tree({ session }, text) {
    const [asked, max] = withCount(text), kind = asked.replace(/^!/, ''), lines = [];
    let depth = Infinity;
    for (const line of session.print('tree').split(/(?<=\n)/).slice(1)) {
        const own = line.search(/\S/);
        if (own <= depth)
            depth = !kind || line.trim().split(/\s/)[0] === `!${kind}` ? own : Infinity;
        if (own >= depth)
            lines.push(kind ? line.slice(depth) : line);
    }
    return lines.length ? someLines(lines, max, `.tree ${asked}`.trim())
        : `-- the frame has no ${kind ? `node !${kind}` : 'nodes'}\n`;
}

function systemsOf({ session }, name) {
    const { systems } = session, found = systems.map((system, i) => [system, i])
        .filter(([system]) => !name || system.name === name || system.name === `:${name}`);
    if (systems.length && !found.length)
        throw problem(`no such system: '${name}'`);
    return found;
}

const short = x => String(Number(x.toPrecision(6)));

function particles(player, text) {
    const [name, max] = withCount(text), found = systemsOf(player, name);
    return found.map(([system, number]) => {
        const vector = (column, i) => column ? Array.from({ length: system.dimensions },
            (_, k) => column.data[i * column.stride + k]) : null;
        const rows = Array.from({ length: Math.min(system.count, max) }, (_, i) => {
            const velocity = vector(system.velocity, i);
            return [player.session.particleId(number, i) ?? '', vector(system.position, i)?.map(short).join(';') ?? '-',
                velocity?.map(short).join(';') ?? '-', velocity ? short(Math.hypot(...velocity)) : '-'];
        });
        const more = system.count - rows.length;
        return `${system.name}: ${plural(system.count, 'particle')}\n${columns([['id', 'position', 'velocity', 'speed'], ...rows])}`
            + (more > 0 ? `-- ${more} more particles; '.particles${name && ` ${name}`} all' shows all\n` : '');
    }).join('') || '-- no particle system was updated in this frame\n';
}

function why(player, text) {
    const [id, max] = /^\S+$/.test(text) ? [text, Infinity] : withCount(text), given = player.session.evaluate(id).text, answers = [];
    for (const [system, number] of systemsOf(player, '')) {
        for (let i = 0; i < system.count; i++) {
            const own = player.session.particleId(number, i);
            if (own !== given && `${system.name};${own}` !== given)
                continue;
            if (!system.steps) {
                answers.push(`${system.name};${own}: took no step in this frame\n`);
                continue;
            }
            const { contributions, sum } = player.session.explain(number, i);
            const rows = contributions.slice(0, max).map(({ kind, partner, vector, file, line }) =>
                [kind ?? 'own force', partner ?? '-', vector.join(';'), file ? `${file}:${line}` : '-']);
            answers.push(`${system.name};${own}: ${plural(contributions.length, 'contribution')}\n${
                columns([['force', 'from', 'contribution', 'script'], ...rows, ['sum', '', sum.join(';'), '']])}`);
        }
    }
    if (!answers.length)
        throw problem(`no particle has the id ${given} in this frame`);
    return answers.join('');
}

const described = ({ name, value, min, max, comment }) =>
    [name, value, Number.isFinite(min) || Number.isFinite(max) ? `${min}..${max}` : '', comment];

function parameters({ session }) {
    const rows = session.parameters.map(described);
    return rows.length ? columns(rows)
        : '-- the script has no parameters; to add one, write `let SIZE=SIZE or 20 -- 1..100 how large`\n';
}

function set(player, text, context) {
    const [, name, value] = text.match(/^([^\s=]*)\s*=?\s*(.*)$/s);
    if (!name)
        return parameters(player);
    if (!player.session.parameters.some(parameter => parameter.name === name))
        throw problem(`'${name}' is not a parameter of the script; .set expects NAME VALUE, such as '.set COUNT 50'`);
    if (value) {
        player.set(name, value);
        context.moved = true;
    }
    const [, own, range, comment] = described(player.session.parameters.find(parameter => parameter.name === name));
    return `-- ${name} = ${own}${range && `  (${range})`}${comment && `  ${comment}`}\n`;
}

const rate = name => ({ session }, text) => {
    if (text)
        throw problem(`.${name} cannot set the ${name} in a page; write %pragma ${name}(${text}) in the script`);
    return `${name} = ${session.frame[name]}\n`;
};

// Prints what can be computed from the particles' columns. Anchors have no velocity.
function energy(player, name) {
    return systemsOf(player, name).map(([system, number]) => {
        const { velocity, mass, count, dimensions } = system, momentum = Array(velocity ? dimensions : 0).fill(0);
        let kinetic = 0, fastest = 0, top = -1;
        for (let i = 0; i < count && velocity; i++) {
            const weight = mass ? mass.data[i * mass.stride] : 1, own = velocity.data.subarray(i * velocity.stride);
            let square = 0;
            for (let k = 0; k < dimensions; k++) {
                square += own[k] ** 2;
                momentum[k] += weight * own[k];
            }
            kinetic += 0.5 * weight * square;
            if (Math.sqrt(square) > top)
                [top, fastest] = [Math.sqrt(square), i];
        }
        return `${system.name}: ${plural(count, 'particle')}, ${plural(system.steps, 'step')}\n${columns([
            ['  kinetic energy', short(kinetic)], ['  momentum', momentum.map(short).join(';')],
            ['  fastest particle', `${player.session.particleId(number, fastest)} at ${short(top)}`],
        ])}`;
    }).join('') + "-- 'petri repl' also prints potential energies\n";
}

function drop({ session }, text) {
    if (text && text !== 'all')
        throw problem(`invalid argument: '${text}'; .drop removes nodes, and .drop all removes nodes and names`);
    return `-- ${plural(session.clearPrompt(text === 'all'), 'statement')} removed\n`;
}

function time({ session }, text) {
    let best = Infinity;
    const end = performance.now() + 200;
    for (let count = 0; count < 100000 && (count < 3 || performance.now() < end); count++) {
        const start = performance.now();
        session.evaluate(text);
        best = Math.min(best, performance.now() - start);
    }
    return `-- ${best < 0.01 ? 'less than 0.01' : short(best)} ms, the fastest of several evaluations\n`;
}

function help({ session }, topic) {
    if (!topic)
        return `${columns(COMMANDS.map(([name, operands, about]) => [`${name} ${operands}`.trim(), about]))}`
            + 'Other input is code: the value of an expression is printed; let, func and nodes are kept.\n';
    const command = COMMANDS.find(([name]) => name === topic);
    if (command)
        return `${command[0]} ${command[1]}`.trim() + `\n    ${command[2]}\n`;
    const rows = session.help(), isNode = topic.startsWith('!'), name = topic.replace(/^!/, '');
    const wanted = topic === 'builtins' ? rows.filter(({ kind }) => kind === 'function')
        : topic === 'nodes' ? rows.filter(({ kind }) => kind === 'node')
            : rows.filter(({ kind, name: own }) => own === name && (isNode ? kind === 'node' : kind !== 'attribute'));
    if (!wanted.length)
        throw problem(`no help for '${topic}'; run .help for a list`);
    const attributes = wanted.length === 1 && wanted[0].kind === 'node' ? attributesOf(rows, wanted[0]) : [];
    return columns([...wanted, ...attributes].map(({ kind, name: own, parameters: of, help: about }) =>
        [kind === 'node' ? `!${own}` : kind === 'function' ? `${own}(${of})` : kind === 'attribute' ? `    ${own}` : own, about]));
}

function attributesOf(rows, node) {
    const after = rows.slice(rows.indexOf(node) + 1), end = after.findIndex(({ kind }) => kind !== 'attribute');
    return end < 0 ? after : after.slice(0, end);
}

const elsewhere = text => () => {
    throw problem(text);
};
const only = "works only in 'petri repl'";

export const COMMANDS = [
    ['.step', '[N]', 'compute N frames (default: 1)', step],
    ['.run', '[T]', 'compute frames for T seconds of script time, or until Ctrl-C', run],
    ['.until', 'EXPR [--limit N]', 'compute frames until EXPR is true, at most N', until, 'an expression'],
    ['.back', '[N]', 'go back N frames (default: 1), at most to the start', back],
    ['.goto', 'FRAME', 'go to a frame, back or forward; -1: before frame 0',
        (player, text, context) => goTo(player, number(player, text, { min: 0, whole: true }), context), 'the number of a frame'],
    ['.reset', '', 'go back to the start of the session', (player, text, context) => goTo(player, player.first, context)],
    ['.state', '[KEY] [N|all]', 'print the state, or its entries under KEY, such as :cells; at most N lines', state],
    ['.tree', '[KIND] [N|all]', "print the frame's nodes, or only those of KIND; at most N lines", tree],
    ['.particles', '[SYSTEM] [N|all]', 'print particles as a table: id, position, velocity, speed, force', particles],
    ['.energy', '[SYSTEM]', 'print energies, momenta and the fastest particle of each system', energy],
    ['.watch', '[EXPR]', 'print EXPR after each step; without EXPR, list the watched expressions',
        elsewhere(`.watch ${only}; .plot plots an expression in the page`)],
    ['.unwatch', '[EXPR]', 'stop watching EXPR, or everything', elsewhere(`.unwatch ${only}; the × in the panel Plot ends a plot`)],
    ['.why', 'ID [N|all]', 'print the forces on a particle; `all` or N lists single contributions', why, 'the id of a particle'],
    ['.plot', 'EXPR [N]', 'plot the number EXPR over the last N frames (default: 60)', (player, text, context) => {
        player.session.evaluate(text); // reports errors
        context.plot = text;
        return '';
    }, 'an expression'],
    ['.show', '', "show the frame's picture in the terminal", elsewhere(`.show ${only}; the page always shows the picture`)],
    ['.parameters', '', "list the script's parameters: value, default, range, comment", parameters],
    ['.set', '[NAME [VALUE]]', 'set a parameter of the script, as -D does, or show it', set],
    ['.tempo', '[T]', 'show or set the beats per minute', rate('tempo')],
    ['.fps', '[F]', 'show or set the frames per second', rate('fps')],
    ['.resolution', '[R | off]', 'show or set the maximum time step of all systems',
        elsewhere(`.resolution ${only}; in the page, set the attribute resolution of !physics`)],
    ['.drop', '[all]', 'remove nodes added at the prompt; with `all`, also names', drop],
    ['.load', 'FILE', 'load another script and start with an empty state',
        elsewhere(`.load ${only}; in the page, use Open`), 'the name of a file'],
    ['.reload', '', 'reload the script; keep state and frame number', elsewhere(`.reload ${only}; in the page, Run loads the script`)],
    ['.save', 'FILE', 'write the state to a file', elsewhere(`.save ${only}; in the page, use Export or Copy link`), 'the name of a file'],
    ['.restore', 'FILE', 'load the state from a file and restart the history',
        elsewhere(`.restore ${only}; the page opens links and archives`), 'the name of a file'],
    ['.archive', 'FILE', 'write an archive of all later frames, for petri archive verify', elsewhere(`.archive ${only}`),
        'the name of a file'],
    ['.record', 'FILE [K]', 'write every K-th frame (default: 1) as a golden for petri test', elsewhere(`.record ${only}`),
        'the name of a file'],
    ['.time', 'EXPR', 'measure the time of an expression or a command', time, 'an expression'],
    ['.help', '[TOPIC]', 'show help for a topic; `builtins` lists all functions, `nodes` all nodes', help],
    ['.quit', '', 'quit', elsewhere(`.quit ${only}; close the page instead`)],
];

// Executes a command. Returns { text, failed, moved, runs, plot }: the page prints `text`; `moved` is true if another frame must be shown,
// `runs` if the page must run the script; `plot` is an expression to plot.
export async function execute(player, line, shouldInterrupt) {
    const [, name, rest] = line.trim().match(/^(\S*)\s*(.*)$/s), context = { shouldInterrupt, moved: false };
    try {
        const found = COMMANDS.find(([own]) => own === name), [, operands, , act, needed] = found ?? [];
        if (!found)
            throw problem(`no such command: '${name}'; run .help for a list`);
        if (!operands && rest)
            throw problem(`${name} takes no arguments: '${rest}'`);
        if (needed && !rest)
            throw problem(`${name} needs ${needed}`);
        const text = await act(player, rest, context);
        return { text, moved: context.moved, runs: context.runs, plot: context.plot };
    } catch (error) {
        if (!error.isMessage)
            throw error;
        return { text: `${error.message}\n`, failed: true, moved: context.moved };
    }
}

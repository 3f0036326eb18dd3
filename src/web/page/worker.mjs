// worker.mjs: the engine's thread. It answers every message, one at a time, so the page knows when the thread is idle.
import { loadEngine } from '../engine/petri.mjs';
import { hasSimd } from '../engine/simd.mjs';
import { addImage, imageOf, paint, sizeOf } from './paint.mjs';
import { Player } from './player.mjs';
import { passes } from './task.mjs';
import { StateTable, Watches } from './tables.mjs';

/* global CELLS_FILE, EXPORTS_FILE -- build.mjs defines the addresses of cells.js and exports.js. */
const STEP_TIME = 30; // ms that the frames of one picture may take
const SEEK_STEPS = 50; // frames between checks for new requests
let engine, player, checker, cells, hasArchives = false, reported = [], flag = null, current = 0;

// The page sets the flag to the id of the last request to interrupt. All earlier requests are interrupted as well.
const shouldInterrupt = () => flag !== null && Atomics.load(flag, 0) >= current;
const images = new Map();
const report = diagnostic => reported.push(diagnostic);

const watches = new Watches(reported), stateTable = new StateTable();
let chosen = null; // the particle on which the user has clicked

const picture = automatic => player.frame >= 0 ? player.session.render({ automatic }) : null;

// Returns the data of the current frame that the page shows.
function shown(extra = {}) {
    const { session } = player;
    return {
        type: 'frame', frame: player.frame, lastFrame: player.lastFrame, time: session.frame.time, fps: session.frame.fps,
        picture: picture(player.automatic), drawable: session.drawable, log: player.takeLog(),
        parameters: session.parameters, verification: player.verification, reported: take(), ...extra,
    };
}

// Loads a module that few visitors need.
const later = file => import(file).catch(() => {
    throw new Error(`cannot load ${file.replace(/\?.*/, '')}; reload the page`);
});

const take = () => reported.splice(0);

// Returns the diagnostics of a script.
function check(text, name) {
    checker ??= engine.open({ files: player.files, shouldInterrupt });
    Object.entries(player.files).forEach(([file, bytes]) => checker.setFile(file, bytes));
    return checker.diagnose(text, name);
}

async function load(source) {
    const loaded = await loadEngine(source);
    loaded.onContextChange = lost => {
        if (!lost)
            player.redraw();
        postMessage({ type: 'context', lost });
    };
    return loaded;
}

// Replaces the engine by the one with archives, unless this was done before. The current session keeps its engine.
async function loadArchives() {
    if (hasArchives)
        return;
    if (!hasSimd())
        throw new Error('archives need WebAssembly SIMD, which this browser lacks');
    engine = await load(new URL('./petri/engine-archives.wasm', import.meta.url));
    hasArchives = true;
    player.engine = engine;
    checker = undefined;
}

const handlers = {
    async open({ source, flag: shared }) {
        flag = shared;
        engine = await load(source);
        const options = { keepForces: true, onDiagnostic: report, shouldInterrupt, image: name => imageOf(images, name) };
        player = new Player(engine, options, watches);
        return { type: 'ready', version: engine.version, help: engine.open().help() };
    },
    async files({ files }) {
        for (const [name, bytes] of Object.entries(files))
            await addImage(images, name, bytes);
        player.files = files;
        Object.entries(files).forEach(([name, bytes]) => player.session?.setFile(name, bytes));
        return { type: 'done' };
    },
    check: ({ text, name }) => ({ type: 'checked', problems: check(text, name) }),
    // Checks a changed script. If it has no errors, replaces the script of the session, and shows the current frame again if `again` is
    // true, unless its picture depends on earlier pictures.
    edit({ text, name, again }) {
        const problems = check(text, name);
        if (problems.some(({ level }) => level === 'error'))
            return { type: 'checked', problems };
        const draws = again && !player.needsHistory;
        player.automatic = false;
        player.edit(text, draws);
        return draws ? shown({ problems, applied: true }) : { type: 'checked', problems, applied: true };
    },
    load({ text, name, changes }) {
        player.load(text, name, changes);
        watches.forget(-1);
        player.automatic = false;
        player.step();
        // The picture in this answer does not show the particles at their positions; pictures do so from frame 2 on.
        return shown({ loaded: true });
    },
    // Replays an archive, whose bytes are in `bytes`.
    async archive({ bytes }) {
        await loadArchives();
        const archive = engine.openArchive(bytes);
        try {
            const problem = archive.check(), { files, info } = archive;
            if (problem)
                throw new Error(`cannot read the archive: ${problem}`);
            for (const file of files)
                await addImage(images, file.name, file.bytes);
            const script = files.find(({ name }) => name === info.script);
            player.replay(archive, script ? new TextDecoder().decode(script.bytes) : '');
        } catch (error) {
            archive.close();
            throw error;
        }
        watches.forget(-1);
        player.automatic = false;
        player.step();
        return shown({ script: { text: player.text, name: player.name } });
    },
    // Computes at least one and at most `count` frames, in about 30 ms.
    step({ count }) {
        const end = performance.now() + STEP_TIME;
        for (let i = 0; i < count && (i === 0 || performance.now() < end); i++)
            player.step();
        return shown();
    },
    // If `limited` is true, stops at the limit of work for links.
    async seek({ frame, limited }) {
        const limit = limited ? engine.memory.wasm.web_link_work_limit() : Infinity, exceeds = () => player.session.work > limit;
        while (!shouldInterrupt() && !player.seek(frame, SEEK_STEPS, exceeds) && !exceeds())
            await new Promise(resolve => setTimeout(resolve));
        return shown(player.frame < frame && exceeds() ? { limit } : {});
    },
    // Shows the current frame again after a frame was aborted.
    shown() {
        player.seek(player.frame);
        return shown();
    },
    // From now on, draws the automatic picture of the particles, until a script is loaded. The page sends this if it cannot
    // draw the script's picture.
    automatic() {
        player.automatic = true;
        return shown();
    },
    set({ name, value }) {
        player.set(name, value);
        return shown();
    },
    digest() {
        return { type: 'digest', digest: player.session.digest(), changes: player.changes, frame: player.frame };
    },
    hash: () => ({ type: 'hash', hash: player.session.hash() }),
    task: message => ({ type: 'task', passed: passes(engine, message, { files: player.files, shouldInterrupt }) }),
    // Executes an input of the prompt. In the answer, `runs` is true if the page must run the script, and `plot` is an expression to plot.
    prompt({ text }) {
        const asked = {}, moves = act => (...given) => {
            asked.log = ''; // another frame is shown, and the prompt prints its log
            player[act](...given);
        };
        const done = player.session.execute(text, {
            first: player.first, last: player.lastFrame, step: moves('step'), goTo: moves('seek'), set: moves('set'), move: moves('move'),
            run: () => (asked.runs = true), plot: expression => (asked.plot = expression),
        });
        return 'log' in asked ? shown({ ...done, ...asked }) : { type: 'printed', reported: take(), ...done, ...asked };
    },
    state: query => ({ type: 'state', ...stateTable.rows(player, query) }),
    choose({ x, y }) {
        const found = player.frame >= 0 ? player.session.pick(x, y, player) : null;
        chosen = found ?? chosen;
        return { type: 'chosen', found: !!found };
    },
    forces: () => ({
        type: 'forces', key: chosen && `${chosen.name};${chosen.id}`, ...chosen && player.session.describe(chosen), frame: player.frame,
        reported: take(),
    }),
    watch({ texts }) {
        watches.set(texts);
        if (player.frame >= 0)
            watches.refill(player, shouldInterrupt);
        return { type: 'done' };
    },
    series: () => ({ type: 'series', series: watches.series(player.lastFrame), frame: player.frame }),
    // Calls a method of Cells.
    async grid({ run, ...message }) {
        cells ??= new (await later(CELLS_FILE)).Cells({ player, images, paint });
        return { type: 'grid', ...cells[run](message) };
    },
    // Exports a range of frames to a file.
    async save({ id, kind, from, to }) {
        const range = { from, to, shouldInterrupt, onProgress: (done, of) => postMessage({ type: 'progress', id, done, of }) };
        const { makeFile } = await later(EXPORTS_FILE);
        return { type: 'saved', blob: await makeFile(kind, { player, images, show: picture, paint, sizeOf }, range) };
    },
    pointer({ inside, x, y, buttons }) {
        player.session.pointer(inside, x, y, buttons);
        return { type: 'done' };
    },
    key({ name, pressed }) {
        player.session.key(name, pressed);
        return { type: 'done' };
    },
};

const failure = error => engine?.broken ? 'broken' : error.status === 'interrupted' ? 'stopped' : 'failed';

let last = Promise.resolve();
onmessage = ({ data }) => {
    last = last.then(async () => {
        current = data.id;
        try {
            if (shouldInterrupt())
                throw Object.assign(new Error('stopped'), { status: 'interrupted' });
            const answer = await handlers[data.act](data);
            postMessage({ ...answer, id: data.id }, answer.picture ? [answer.picture.image ?? answer.picture.numbers.buffer] : []);
        } catch (error) {
            const { message, diagnostics = [] } = error;
            postMessage({ type: failure(error), id: data.id, message, reported: take(), diagnostics });
        }
    });
};

// worker.mjs: the engine's thread. Messages come one at a time and each is answered, so that the page knows when it is free.
import { loadEngine } from '../engine/petri.mjs';
import { Player } from './player.mjs';

const SEEK_STEPS = 50; // frames between looks at what the page wants
let engine, player, checker, told = [], flag = null, current = 0;

// The page writes which question is to be given up, and all before it.
const wantsEnd = () => flag !== null && Atomics.load(flag, 0) >= current;
const images = new Map(), baseName = name => name.replace(/^.*\//, '');
const tell = diagnostic => told.push(diagnostic);

// What the page shows after a frame.
function shown(extra = {}) {
    const { session } = player, picture = player.frame >= 0 ? session.show({ automatic: player.automatic }) : null;
    return {
        type: 'frame', frame: player.frame, most: player.most, time: session.frame.time, fps: session.frame.fps,
        picture, log: player.frame >= 0 ? session.log() : '', parameters: session.parameters, told: take(), ...extra,
    };
}

const take = () => told.splice(0);

const acts = {
    async open({ source, flag: shared }) {
        flag = shared;
        engine = await loadEngine(source);
        player = new Player(engine, { onDiagnostic: tell, wantsEnd, image: name => images.get(baseName(name)) });
        return { type: 'ready', version: engine.version, help: engine.open().help() };
    },
    async files({ files }) {
        for (const [name, bytes] of Object.entries(files))
            if (/\.(png|jpe?g|gif|webp)$/i.test(name))
                images.set(baseName(name), await createImageBitmap(new Blob([bytes])).catch(() => null));
        player.files = files;
        Object.entries(files).forEach(([name, bytes]) => player.session?.setFile(name, bytes));
        return { type: 'done' };
    },
    check({ text, name }) {
        checker ??= engine.open({ files: player.files, wantsEnd });
        Object.entries(player.files).forEach(([file, bytes]) => checker.setFile(file, bytes));
        return { type: 'checked', told: checker.diagnose(text, name) };
    },
    load({ text, name, changes }) {
        player.load(text, name, changes);
        player.automatic = false;
        player.step();
        // Particles are not where they will be seen before frame 2.
        return shown({ loaded: true });
    },
    // The same script with another text, while it goes on; what was before is not gone back to.
    reload({ text, name }) {
        player.session.reload(text, name);
        Object.assign(player, { text, name });
        player.forget(-2);
        player.most = player.frame;
        return shown({ loaded: true });
    },
    step({ count }) {
        for (let i = 0; i < count; i++)
            player.step();
        return shown();
    },
    async seek({ frame }) {
        while (!wantsEnd() && !player.seek(frame, SEEK_STEPS))
            await new Promise(resolve => setTimeout(resolve));
        return shown();
    },
    // Where it is, after a frame that was given up.
    shown() {
        player.seek(player.frame);
        return shown();
    },
    // The particles themselves, for what the page cannot draw.
    automatic() {
        player.automatic = true;
        return shown();
    },
    set({ name, value }) {
        player.set(name, value);
        return shown();
    },
    hash() {
        return { type: 'hash', hash: player.session.hash(), changes: player.changes, frame: player.frame };
    },
    prompt({ text }) {
        return { type: 'printed', text: player.session.prompt(text), told: take() };
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
            if (wantsEnd())
                throw Object.assign(new Error('stopped'), { status: 'interrupted' });
            const answer = await acts[data.act](data);
            postMessage({ ...answer, id: data.id }, answer.picture ? [answer.picture.image ?? answer.picture.numbers.buffer] : []);
        } catch (error) {
            postMessage({ type: failure(error), id: data.id, message: error.message, told: take(), diagnostics: error.diagnostics ?? [] });
        }
    });
};

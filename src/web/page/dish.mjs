// dish.mjs: a script on a canvas: loads, runs, goes back. The page and <petri-dish> are made of it.
import { Remote } from './engine.mjs';
import { addImage, paint, sizeOf } from './paint.mjs';
import { NO_ENGINE, hasEngine } from './feature_check.mjs';

const MAX_STEPS = 8; // frames between two pictures: a script that is slower falls behind
const SLOW = 500; // ms: what takes longer, a person may want to stop
const FIRST_SEEN = 2; // before, particles are not where they will be seen

export class Dish {
    // host: what is called: shown(answer, left out), failed(error, what was told), changed() when it runs or
    // not any more; and, where they are, loaded() and slow(whether).
    constructor(canvas, host, { source, worker }) {
        Object.assign(this, {
            canvas, host, running: false, loaded: null, name: null, frame: -1, lastFrame: -1, fps: 60, speed: 1, behind: 0, last: 0, turn: 0,
            files: new Map(), images: new Map(), wanted: null, pressed: new Set(),
        });
        this.remote = hasEngine() ? new Remote(source, worker) : null;
    }

    get ready() {
        return this.remote?.ready ?? Promise.reject(new Error(NO_ENGINE));
    }

    ask(act, message) {
        return this.remote?.ask(act, message) ?? Promise.reject(new Error(NO_ENGINE));
    }

    // Asks the engine; null after a failure, which the host is told of.
    async attempt(act, message) {
        const slow = setTimeout(() => this.host.slow?.(true), SLOW);
        try {
            return await this.ask(act, message);
        } catch (error) {
            await this.fail(error);
            return null;
        } finally {
            clearTimeout(slow);
            this.host.slow?.(false);
        }
    }

    async fail(error) {
        this.running = false;
        const seen = new Set(), told = [...(error.diagnostics ?? []), ...(error.told ?? [])];
        this.host.failed(error, told.filter(({ rendered }) => !seen.has(rendered) && seen.add(rendered)));
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

    draw({ picture }) {
        if (!picture)
            return [];
        const { canvas } = this, { width, height } = sizeOf(picture);
        if (canvas.width !== width || canvas.height !== height)
            Object.assign(canvas, { width, height });
        return paint(canvas.getContext('2d'), picture, this.images);
    }

    show(answer) {
        Object.assign(this, { frame: answer.frame, lastFrame: answer.lastFrame, fps: answer.fps, parameters: answer.parameters });
        const left = this.draw(answer);
        this.host.shown(answer, left);
        if (left.includes('canvas3d'))
            this.attempt('automatic').then(other => other?.picture && this.draw(other));
        this.host.changed();
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
        Object.assign(this, { loaded: text, name });
        this.host.loaded?.();
        this.show(answer);
        return true;
    }

    // Loads, and goes to a frame. True; false after a failure; or the hash of the state if it is another one.
    async open(text, name, { changes = [], frame = 0, hash = null } = {}) {
        if (!await this.load(text, name, changes) || !await this.showAnswer('seek', { frame: frame || (hash ? 0 : FIRST_SEEN) }))
            return false;
        const answer = hash && await this.attempt('hash');
        return !answer || answer.hash === hash || answer.hash;
    }

    run() {
        if (this.running || this.loaded === null)
            return;
        const turn = ++this.turn;
        Object.assign(this, { running: true, last: performance.now(), behind: 0 });
        this.host.changed();
        requestAnimationFrame(now => this.tick(now, turn));
    }

    pause() {
        this.running = false;
        this.host.changed();
    }

    // At display rate: as many frames as the time since the last one is worth, when the engine is free. What was paused and
    // run again while a frame was made has another turn: the one before must not go on beside it.
    async tick(now, turn) {
        if (!this.running || turn !== this.turn)
            return;
        this.behind = Math.min(this.behind + Math.max(now - this.last, 0) / 1000 * this.fps * this.speed, MAX_STEPS);
        this.last = now;
        const count = Math.floor(this.behind);
        this.behind -= count;
        if (count > 0)
            await this.showAnswer('step', { count });
        requestAnimationFrame(later => this.tick(later, turn));
    }

    async step() {
        this.running = false;
        await this.showAnswer('step', { count: 1 });
    }

    // One question at a time: while a drag goes on, only where it has come to counts.
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

    async set(name, value) {
        const answer = await this.attempt('set', { name, value });
        if (answer && !this.running)
            this.show(answer);
    }

    // Ends what the engine is at. True if it could be ended alone; else the engine has gone with it.
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

    // --- what it is given

    // A script reads what is given, and nothing else.
    async addFile(name, bytes) {
        this.files.set(name, bytes);
        await addImage(this.images, name, bytes);
    }

    giveFiles() {
        return this.attempt('files', { files: Object.fromEntries(this.files) });
    }

    // The pointer and keys go to the script while the picture has the focus.
    listen() {
        const { canvas } = this;
        canvas.onpointermove = canvas.onpointerdown = canvas.onpointerup = event => this.point(event, true);
        canvas.onpointerleave = event => this.point(event, false);
        canvas.onkeydown = event => this.press(event);
        canvas.onkeyup = event => this.releaseKey(keyName(event));
        canvas.onblur = () => this.pressed.forEach(name => this.releaseKey(name));
    }

    point(event, inside) {
        if (this.loaded === null)
            return;
        const box = this.canvas.getBoundingClientRect(), share = (x, from, size) => Math.min(Math.max((x - from) / size, 0), 1);
        const [left, right, middle] = [event.buttons & 1, event.buttons & 2, event.buttons & 4];
        this.attempt('pointer', {
            inside, x: share(event.clientX, box.left, box.width), y: share(event.clientY, box.top, box.height),
            buttons: left | (middle ? 2 : 0) | (right ? 4 : 0),
        });
    }

    // Tab, and what is pressed with Control or Alt, stay the browser's; keys that scroll are the script's.
    press(event) {
        const name = keyName(event);
        if (this.loaded === null || !name || event.ctrlKey || event.metaKey || event.altKey)
            return;
        if (event.key.length === 1 || /^(Arrow|Page|Home|End)/.test(event.key))
            event.preventDefault();
        this.pressed.add(name);
        this.ask('key', { name, pressed: true }).catch(() => {});
    }

    releaseKey(name) {
        if (this.pressed.delete(name))
            this.ask('key', { name, pressed: false }).catch(() => {});
    }
}

// As petri has it, of what a browser calls it.
const KEYS = {
    ' ': 'space', ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'up', ArrowDown: 'down', Enter: 'enter', Escape: 'escape',
    Backspace: 'backspace', Insert: 'insert', Delete: 'delete', PageUp: 'page_up', PageDown: 'page_down', Home: 'home', End: 'end',
    "'": 'apostrophe', ',': 'comma', '-': 'minus', '.': 'period', '/': 'slash', ';': 'semicolon', '=': 'equal', '[': 'left_bracket',
    '\\': 'backslash', ']': 'right_bracket', '`': 'grave_accent',
};

function keyName({ key, code }) {
    if (key === 'Shift')
        return code === 'ShiftRight' ? 'right_shift' : 'left_shift';
    return /^([a-z0-9]|F\d+)$/i.test(key) ? key.toLowerCase() : KEYS[key] ?? null;
}

// What to say of an error.
export const errorText = error => error.type === 'stopped' ? 'Stopped; the frame before is still there.'
    : error.type === 'ended' ? 'Stopped. What the frame was at is given up; Run starts anew.'
        : error.type === 'broken' ? `${error.message}. Run starts anew.` : error.message.split('\n')[0];

// What to say of what a picture leaves out.
export const unsupportedText = ({ picture }, left) =>
    `Not drawn in the browser${picture.screen ? '' : ', which has no WebGL 2'}: ${left.join(', ')}.`;

// main.mjs: the page: what a person does becomes questions to the engine, and its answers are shown.
import { drawPicture } from '../engine/drawing.mjs';
import { Editor } from './editor.mjs';
import { Remote } from './engine.mjs';
import { packLink, readLink } from './link.mjs';
import { Parameters } from './parameters.mjs';

const $ = id => document.getElementById(id);
const KEPT = 'petri.script';
const FIRST = 'dish.fl';
const MOST_STEPS = 8; // frames between two pictures: a script that is slower falls behind

const encoder = new TextEncoder();
const state = { name: FIRST, running: false, loaded: null, frame: -1, most: -1, told: [], help: [], images: new Map(), behind: 0, last: 0, fps: 60, files: new Map() };
let editor, remote, samples, parameters;

function say(text, bad = false) {
    $('message').textContent = text;
    $('message').classList.toggle('error', bad);
}

// --- what was told

function showProblems(told) {
    editor.show(told.filter(({ file }) => file === state.name || file === null));
    $('problems').replaceChildren(...told.filter(({ level }) => level !== 'note').slice(0, 50).map(({ level, file, line, column, text, hint }) => {
        const item = document.createElement('li'), button = document.createElement('button');
        button.className = level;
        button.textContent = `${line ? `${file === state.name ? '' : `${file}:`}${line}:${column}: ` : ''}${level}: ${text}${hint ? `. ${hint}` : ''}`;
        button.onclick = () => line && editor.goTo(line, column);
        item.append(button);
        return item;
    }));
}

function addTold(told) {
    if (!told?.length)
        return;
    state.told.push(...told);
    showProblems(state.told);
}

// Shows what has failed; true if the engine is to be started anew.
function failed(error) {
    state.running = false;
    const told = [...(error.diagnostics ?? []), ...(error.told ?? [])];
    const seen = new Set();
    addTold(told.filter(({ rendered }) => !seen.has(rendered) && seen.add(rendered)));
    say(error.type === 'stopped' ? 'Stopped. What the frame was at is given up; Run starts anew.'
        : error.type === 'broken' ? `${error.message}. Run starts anew.` : error.message.split('\n')[0], true);
    if (error.type === 'broken')
        restart();
    refresh();
}

async function attempt(act) {
    try {
        return await act();
    } catch (error) {
        failed(error);
        return null;
    }
}

// --- pictures

function draw({ picture }) {
    const canvas = $('picture');
    if (!picture)
        return [];
    const [width, height] = picture.image ? [picture.image.width, picture.image.height] : picture.numbers;
    if (canvas.width !== width || canvas.height !== height)
        Object.assign(canvas, { width, height });
    document.title = picture.title ? `${picture.title} · petri` : 'petri';
    if (picture.image) {
        canvas.getContext('2d').drawImage(picture.image, 0, 0);
        picture.image.close();
        return picture.undrawn;
    }
    return drawPicture(canvas.getContext('2d'), picture.numbers, { image: name => state.images.get(name.replace(/^.*\//, '')) });
}

function show(answer) {
    Object.assign(state, { frame: answer.frame, most: answer.most, fps: answer.fps });
    addTold(answer.told);
    const undrawn = draw(answer);
    $('number').textContent = `frame ${answer.frame}, ${answer.time.toFixed(2)} s`;
    Object.assign($('time'), { max: Math.max(answer.most, 0), value: answer.frame });
    if (answer.log)
        print(answer.log);
    if (undrawn.length)
        say(`Not drawn in the browser: ${undrawn.join(', ')}.`);
    if (undrawn.includes('canvas3d'))
        attempt(() => remote.ask('automatic')).then(other => other?.picture && draw(other));
    parameters.show(answer.parameters);
    refresh();
    document.body.dataset.frame = answer.frame;
}

function print(text) {
    const printed = $('printed');
    printed.textContent = (printed.textContent + text).split('\n').slice(-200).join('\n');
    printed.scrollTop = printed.scrollHeight;
}

function refresh() {
    const loaded = state.loaded !== null;
    $('run').textContent = state.running ? 'Pause' : 'Run';
    $('back').disabled = !loaded || state.frame < 1;
    $('step').disabled = $('reset').disabled = $('time').disabled = !loaded;
}

// --- running

// Loads the text of the editor if it is another one than runs.
async function load({ changes = [], always = false } = {}) {
    const { text } = editor;
    if (!always && state.loaded === text)
        return true;
    state.told = [];
    const answer = await attempt(() => remote.ask('load', { text, name: state.name, changes }));
    if (!answer)
        return false;
    state.loaded = text;
    say('');
    showProblems([]);
    show(answer);
    return true;
}

async function run() {
    if (state.running) {
        state.running = false;
        refresh();
        return;
    }
    if (!await load())
        return;
    state.running = true;
    state.last = performance.now();
    state.behind = 0;
    refresh();
    requestAnimationFrame(tick);
}

// At display rate: as many frames as the time since the last one is worth, when the engine is free.
async function tick(now) {
    if (!state.running)
        return;
    const speed = Number($('speed').value);
    state.behind = Math.min(state.behind + (now - state.last) / 1000 * state.fps * speed, MOST_STEPS);
    state.last = now;
    const count = Math.floor(state.behind);
    if (count > 0) {
        state.behind -= count;
        const answer = await attempt(() => remote.ask('step', { count }));
        if (answer)
            show(answer);
    }
    requestAnimationFrame(tick);
}

async function step() {
    state.running = false;
    const before = state.loaded;
    if (await load() && before !== null) {
        const answer = await attempt(() => remote.ask('step', { count: 1 }));
        answer && show(answer);
    }
}

// One question at a time: while a drag goes on, only where it has come to counts.
let wanted = null;
async function seek(frame) {
    state.running = false;
    const waits = wanted !== null;
    wanted = Math.max(frame, 0);
    if (waits)
        return;
    for (let at = null; wanted !== at;) {
        at = wanted;
        const answer = await attempt(() => remote.ask('seek', { frame: at }));
        answer && show(answer);
    }
    wanted = null;
}

async function reset() {
    state.running = false;
    await load({ always: true });
}

async function restart() {
    state.running = false;
    state.loaded = null;
    await remote.restart();
    await remote.ask('files', { files: Object.fromEntries(state.files) });
    refresh();
}

// --- text

let checking = 0;
function changed(text) {
    try {
        localStorage.setItem(KEPT, JSON.stringify({ text, name: state.name }));
    } catch {
        // Private windows keep nothing.
    }
    clearTimeout(checking);
    checking = setTimeout(async () => {
        if (state.running)
            return;
        const answer = await attempt(() => remote.ask('check', { text, name: state.name }));
        if (answer && editor.text === text) {
            state.told = answer.told;
            showProblems(answer.told);
            document.body.dataset.checked = String(answer.told.length);
        }
    }, 250);
}

async function openText(text, name, { changes = [], frame = 0, hash = null } = {}) {
    state.running = false;
    state.name = name;
    editor.text = text;
    if (!await load({ changes, always: true }))
        return;
    const until = Math.max(frame, 2); // before, particles are not where they will be seen
    const answer = await attempt(() => remote.ask('seek', { frame: frame > 0 ? frame : until }));
    answer && show(answer);
    if (answer && hash) {
        const { hash: here } = await remote.ask('hash');
        say(here === hash ? `Frame ${frame}: the same state as where the link was made, to the last bit.`
            : `Frame ${frame}: the state is not that where the link was made. It was made by another version of petri, perhaps.`, here !== hash);
    }
}

async function copyLink() {
    const loaded = state.loaded === editor.text && state.frame >= 0;
    const answer = loaded ? await attempt(() => remote.ask('hash')) : null;
    const link = await attempt(() => packLink({ text: editor.text, name: state.name, ...(answer ?? {}) }));
    if (!link)
        return;
    history.replaceState(null, '', link);
    const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    say(copied ? 'The link is copied; nothing has left this machine.' : 'The link is in the address bar.');
}

function saveAs(name, blob) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    URL.revokeObjectURL(link.href);
}

const save = () => saveAs(state.name, new Blob([editor.text], { type: 'text/plain' }));
const saveImage = () => $('picture').toBlob(blob => blob && saveAs(state.name.replace(/\.fl$/, '') + `-${state.frame}.png`, blob));

// Scripts, and what they read; the script to run is the first, unless one is open and these are files beside it.
async function takeFiles(files) {
    for (const file of files) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        state.files.set(file.name, bytes);
        if (/\.(png|jpe?g|gif|webp)$/i.test(file.name))
            state.images.set(file.name, await createImageBitmap(file).catch(() => null));
    }
    await attempt(() => remote.ask('files', { files: Object.fromEntries(state.files) }));
    const script = [...files].find(({ name }) => name.endsWith('.fl'));
    if (script)
        await openText(new TextDecoder().decode(state.files.get(script.name)), script.name);
}

// --- hands

function pointer(event, inside) {
    if (state.loaded === null)
        return;
    const box = $('picture').getBoundingClientRect();
    const share = (x, from, size) => Math.min(Math.max((x - from) / size, 0), 1);
    const [left, right, middle] = [event.buttons & 1, event.buttons & 2, event.buttons & 4];
    attempt(() => remote.ask('pointer', {
        inside, x: share(event.clientX, box.left, box.width), y: share(event.clientY, box.top, box.height),
        buttons: left | (middle ? 2 : 0) | (right ? 4 : 0),
    }));
}

const KEYS = { ' ': 'space', ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'up', ArrowDown: 'down', Enter: 'return' };
function key(event, pressed) {
    const name = KEYS[event.key] ?? (/^[a-z0-9]$/i.test(event.key) ? event.key.toLowerCase() : null);
    if (state.loaded === null || !name || event.ctrlKey || event.metaKey || event.altKey)
        return;
    event.preventDefault();
    remote.ask('key', { name, pressed }).catch(() => {});
}

function listen() {
    $('run').onclick = run;
    $('step').onclick = step;
    $('back').onclick = () => seek(state.frame - 1);
    $('reset').onclick = reset;
    $('stop').onclick = () => (remote.busy ? restart() : (state.running = false, refresh()));
    $('time').oninput = () => seek(Number($('time').value));
    $('link').onclick = copyLink;
    $('save').onclick = save;
    $('image').onclick = saveImage;
    $('open').onclick = () => $('file').click();
    $('file').onchange = () => takeFiles($('file').files);
    $('samples').onchange = () => {
        const name = $('samples').value;
        if (name)
            openText(samples[name], name);
    };
    $('theme').onclick = () => {
        const dark = getComputedStyle(document.documentElement).colorScheme === 'dark'
            || (!document.documentElement.dataset.theme && matchMedia('(prefers-color-scheme: dark)').matches);
        document.documentElement.dataset.theme = dark ? 'light' : 'dark';
    };
    $('prompt').onsubmit = async event => {
        event.preventDefault();
        const text = $('line').value;
        print(`? ${text}\n`);
        const answer = await remote.ask('prompt', { text: `${text}\n` }).catch(error => ({ text: `${error.message}\n` }));
        print(answer.text);
        $('line').value = '';
    };
    const picture = $('picture');
    picture.onpointermove = picture.onpointerdown = picture.onpointerup = event => pointer(event, true);
    picture.onpointerleave = event => pointer(event, false);
    picture.onkeydown = event => key(event, true);
    picture.onkeyup = event => key(event, false);
    document.ondragover = event => event.preventDefault();
    document.ondrop = event => {
        event.preventDefault();
        takeFiles(event.dataTransfer.files);
    };
    addEventListener('hashchange', () => location.hash && openLink());
}

async function openLink() {
    const linked = await attempt(() => readLink(location.hash));
    if (linked)
        await openText(linked.text, linked.name, linked);
    return linked !== null;
}

function kept() {
    try {
        return JSON.parse(localStorage.getItem(KEPT));
    } catch {
        return null;
    }
}

async function begin() {
    const given = await (await fetch('samples.json')).json();
    samples = given.scripts;
    state.files = new Map(Object.entries(given.files).map(([name, text]) => [name, encoder.encode(text)]));
    $('samples').append(...Object.keys(samples).map(name => new Option(name.replace(/\.fl$/, ''), name)));
    const before = kept();
    state.name = before?.name ?? FIRST;
    remote = new Remote(new URL('petri/engine.wasm', location.href).href);
    editor = new Editor($('editor'), { text: before?.text ?? samples[FIRST], onChange: changed, onRun: run, help: () => state.help });
    parameters = new Parameters($('parameters'), async (name, value) => {
        const answer = await attempt(() => remote.ask('set', { name, value }));
        answer && !state.running && show(answer);
    });
    listen();
    refresh();
    const ready = await attempt(() => remote.ready);
    if (!ready)
        return;
    state.help = ready.help;
    await remote.ask('files', { files: Object.fromEntries(state.files) });
    if (!(location.hash.length > 1 && await openLink()))
        await openText(editor.text, state.name);
    document.body.dataset.ready = ready.version;
    if ('serviceWorker' in navigator && location.protocol !== 'file:')
        navigator.serviceWorker.register('offline.js').catch(() => {});
}

if (typeof WebAssembly === 'undefined' || !WebAssembly.validate(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3,
    2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11])))
    say('This browser has no WebAssembly with SIMD, which petri takes: one of 2021 or later has.', true);
else
    begin();

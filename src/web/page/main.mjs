// main.mjs: the playground page: an editor beside a dish, and the actions of the buttons.
import { engineFile } from '../engine/simd.mjs';
import { CONTROLS, Controls } from './controls.mjs';
import { Dish } from './dish.mjs';
import { Editor } from './editor.mjs';
import { Gallery } from './gallery.mjs';
import { Hint } from './hint.mjs';
import { Keys } from './keys.mjs';
import { SPEC } from './link.mjs';
import { Live } from './live.mjs';
import { say } from './message.mjs';
import { Particle } from './particle.mjs';
import { Plot } from './plot.mjs';
import { Problems } from './problems.mjs';
import { Prompt } from './prompt.mjs';
import { reportTo } from './report.mjs';
import { SaveDialog, saveAs } from './save.mjs';
import { Splitter } from './splitter.mjs';
import { Scripts } from './scripts.mjs';
import { Table } from './table.mjs';
import { Tabs } from './tabs.mjs';
import { listenForTheme } from './theme.mjs';
import { Transfer } from './transfer.mjs';

/* global GRID_FILE -- build.mjs defines the address of grid.js. */
const $ = id => document.getElementById(id);
const FIRST = 'dish.fl';

const encoder = new TextEncoder();

// What the modules of the page share: the script's name, the samples, editor, dish, problems, live, scripts and controls.
const page = {
    name: FIRST, samples: {}, pictures: {}, say, openText,
    // The name of the script in diagnostics: the one that it had when it was loaded.
    get file() {
        return page.dish.loaded === null ? page.name : page.dish.name;
    },
};
let prompt, plot, table, particle, saves, hint, help = [];

// --- callbacks of the dish

const report = reportTo(page);
const host = {
    ...report,
    shown(answer, left) {
        report.shown(answer, left);
        prompt.print(answer.log);
        document.title = answer.picture?.title ? `${answer.picture.title} · petri` : 'petri';
        showVerification(answer.verification);
        look();
    },
    slow(is) {
        document.body.classList.toggle('busy', is);
    },
};

// Shows if the frame of an archive is the recorded one.
function showVerification(found) {
    const mark = $('verified'), differs = found?.differs ?? null;
    mark.hidden = !found;
    mark.className = differs !== null ? 'error' : '';
    mark.textContent = !found ? '' : differs !== null ? `✗ frame ${differs} differs from the archive`
        : `${found.same ? '✓ this frame is the recorded one' : 'this frame was not recorded'}; ${found.verified} of ${found.of} verified`;
}

// Updates the panels, at most five times a second while the script runs.
let looking = 0;
function look() {
    looking ||= setTimeout(() => {
        looking = 0;
        plot.refresh();
        table.refresh();
        particle.refresh();
    }, page.dish.running ? 200 : 0);
}

// --- the editor's text

function changed(text) {
    page.scripts.edited(text);
    if (location.hash)
        history.replaceState(null, '', location.pathname + location.search); // the text no longer matches the link
    page.live.changed();
}

// Opens a script: a stored one if it has an id. With `play`, it runs, unless the user prefers reduced motion.
async function openText(text, name, { id = null, play = false, ...wanted } = {}) {
    page.scripts.show(text, name, id);
    hint.opened(text);
    page.dish.unload();
    page.problems.show([], name);
    const opened = await page.dish.open(text, name, wanted), kind = wanted.digest ? 'digest' : 'SHA-256';
    if (opened?.digest)
        say(opened.same ? `Frame ${wanted.frame}: the state matches the link exactly (${kind} ${opened.digest}).`
            : `Frame ${wanted.frame}: the state differs from the link, probably because another version of petri made the link${
                wanted.spec === SPEC ? '' : `, by version ${wanted.spec} of the specification`}.`,
        !opened.same);
    if (opened && play && !matchMedia('(prefers-reduced-motion: reduce)').matches)
        page.dish.run();
}

async function run() {
    if (await page.live.apply())
        page.dish.run();
}

async function restart() {
    if (await page.live.restart())
        page.dish.run();
}

let grid = null;
async function showGrid(source) {
    grid ??= import(GRID_FILE).then(({ Grid }) => new Grid(page, source)); // few visitors need it
    await grid.then(one => one.show()).catch(error => {
        grid = null;
        say(`cannot load the grid: ${error.message}; reload the page`, true);
    });
}

const stem = () => page.name.replace(/\.fl$/, '');

function listen() {
    const save = () => saveAs(page.name, new Blob([page.editor.text], { type: 'text/plain' }));
    $('save').onclick = save;
    new Keys(document, page, { save, savePicture: () => saves.savePicture() });
    new Splitter($('splitter'));
    listenForTheme($('theme'));
}

async function begin() {
    $('below').innerHTML = CONTROLS;
    $('tabs').before($('parameters'));
    const start = globalThis.petriStart ?? { source: new URL(`petri/${engineFile()}`, location.href).href };
    const dish = page.dish = new Dish($('picture'), host, start);
    const given = await (await fetch('samples.json')).json();
    page.samples = given.scripts;
    page.pictures = given.pictures;
    for (const [file, text] of Object.entries(given.files))
        dish.files.set(file, encoder.encode(text));
    page.editor = new Editor($('editor'), { text: '', onChange: changed, onRun: run, onRestart: restart, help: () => help });
    page.scripts = new Scripts(document, page);
    const [before] = page.scripts.library.list();
    hint = new Hint(document, !before, page.samples[FIRST]);
    page.scripts.show(before?.text ?? page.samples[FIRST], before?.name ?? FIRST, before?.id);
    page.problems = new Problems($('problems'), page.editor);
    page.live = new Live(page);
    page.controls = new Controls(document, dish, ({ always = false } = {}) => always ? page.live.restart() : page.live.ready());
    prompt = new Prompt(document, dish, text => {
        plot.watch([...new Set([...plot.texts, text])]);
        tabs.choose($('tab-plot'));
    });
    saves = new SaveDialog(document, dish, stem);
    $('grid-open').onclick = () => showGrid(start.source);
    new Gallery(document, page, start.source);
    plot = new Plot(document, dish);
    table = new Table(document, dish);
    const goTo = (file, line, column) => file === page.file && page.editor.goTo(line, column);
    particle = new Particle(document, dish, goTo, () => tabs.choose($('tab-particle')));
    const tabs = new Tabs($('tabs'), panel => {
        plot.seen = panel === 'panel-plot';
        particle.seen = panel === 'panel-particle';
        table.seen = panel === 'panel-state';
        look();
    });
    const transfer = new Transfer(page);
    dish.listen();
    transfer.listen(document);
    listen();
    const answer = await dish.ready.catch(error => say(error.message, true));
    if (!answer)
        return;
    help = answer.help;
    await dish.giveFiles();
    const why = await transfer.openLink();
    if (why)
        await openText(page.editor.text, page.name, { id: before?.id, play: true });
    if (why && location.hash)
        say(why, true);
    document.body.dataset.ready = answer.version;
    if ('serviceWorker' in navigator && location.protocol !== 'file:' && !globalThis.petriView)
        navigator.serviceWorker.register('offline.js').catch(() => {});
}

begin();

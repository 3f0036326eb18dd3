// preview.mjs: the page of the preview in VS Code. It shows the script that the extension sends (preview_panel.js), with the code of the
// playground.
import { CONTROLS, Controls } from '../../web/page/controls.mjs';
import { Dish } from '../../web/page/dish.mjs';
import { Live } from '../../web/page/live.mjs';
import { say } from '../../web/page/message.mjs';
import { Particle } from '../../web/page/particle.mjs';
import { Problems } from '../../web/page/problems.mjs';
import { reportTo } from '../../web/page/report.mjs';

const $ = id => document.getElementById(id);
const editor = acquireVsCodeApi();

const goTo = (line, column, file = '') => editor.postMessage({ type: 'goTo', file, line, column });

// What the modules of the playground share. The editor is that of VS Code, which underlines errors itself.
const page = {
    name: '', say,
    editor: { text: '', show() {}, goTo },
    get file() {
        return page.dish.loaded === null ? page.name : page.dish.name;
    },
};

// The last message of the extension: { id, name, text, files }. Text and files of messages that arrive during an update are combined.
let shownId = null, wanted = null, files = {}, updating = false;

// Shows the clicked particle, or hides it.
function showParticle(seen) {
    $('particle').hidden = !seen;
    page.particle.seen = seen;
}

// Calls the callbacks of the playground. Updates the particle at most five times a second.
function report() {
    const known = reportTo(page);
    let looking = 0;
    return {
        ...known,
        shown(...answer) {
            known.shown(...answer);
            looking ||= setTimeout(() => {
                looking = 0;
                page.particle.refresh();
            }, 200);
        },
    };
}

// Shows another script from its start, and takes over a changed script with its state.
async function update() {
    const { dish, live } = page, { id, name } = wanted, given = Object.entries(files);
    files = {};
    if (id !== shownId)
        dish.files.clear();
    for (const [file, bytes] of given)
        await dish.addFile(file, bytes);
    if (given.length)
        await dish.giveFiles();
    if (id === shownId && dish.loaded !== null) {
        live.changed();
        await live.applied;
        return;
    }
    Object.assign(page, { name });
    shownId = id;
    dish.unload();
    page.problems.show([], name);
    showParticle(false);
    if (await dish.open(page.editor.text, name) && !matchMedia('(prefers-reduced-motion: reduce)').matches)
        dish.run();
}

async function receive({ data }) {
    files = data.id === wanted?.id ? { ...files, ...data.files } : data.files;
    wanted = data;
    page.editor.text = data.text;
    for (let seen; !updating && seen !== wanted;) {
        seen = wanted;
        updating = true;
        await update();
        updating = false;
    }
}

async function begin() {
    const read = async url => {
        const answer = await fetch(url);
        if (!answer.ok)
            throw new Error(`cannot read ${url}: status ${answer.status}`);
        return answer;
    };
    const { engine, worker } = document.body.dataset;
    const [source, code] = await Promise.all([
        read(engine).then(answer => answer.arrayBuffer()), read(worker).then(answer => answer.text()),
    ]);
    // From a blob, because a worker must have the origin of the page, and the extension's files have another.
    const url = URL.createObjectURL(new Blob([code], { type: 'text/javascript' }));
    globalThis.petriWorker = () => new Worker(url);
    $('below').innerHTML = CONTROLS;
    page.dish = new Dish($('picture'), report(), { source });
    page.problems = new Problems($('problems'), page.editor);
    page.live = new Live(page);
    page.controls = new Controls(document, page.dish, ({ always = false } = {}) => always ? page.live.restart() : page.live.ready());
    page.particle = new Particle(document, page.dish, (file, line, column) => goTo(line, column, file), () => showParticle(true));
    page.dish.listen();
    await page.dish.ready;
    addEventListener('message', receive);
    editor.postMessage({ type: 'ready' });
}

begin().catch(error => say(error.message, true));

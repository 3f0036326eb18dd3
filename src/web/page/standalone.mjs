// standalone.mjs: the page that `petri link --html` writes: a file with engine, script and files, which runs without a server.
import { hasSimd } from '../engine/simd.mjs';
import { CONTROLS, Controls } from './controls.mjs';
import { Dish, errorText, unsupportedText } from './dish.mjs';
import { readLink } from './link.mjs';
import { say } from './message.mjs';

const $ = id => document.getElementById(id);
const decoded = text => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), character => character.charCodeAt(0));
const unpacked = id => new Response(new Blob([decoded($(id).textContent.trim())]).stream().pipeThrough(new DecompressionStream('gzip')));

let dish, controls, linked, asked = 0;

// Shows the digest of the current frame, and whether it is the stored one.
async function showDigest() {
    const frame = dish.frame, answer = await dish.attempt('digest');
    if (!answer || frame !== dish.frame || dish.running)
        return;
    const same = answer.frame !== linked.frame || answer.changes.length !== linked.changes.length ? null : answer.digest === linked.digest;
    $('hash').textContent = `Frame ${answer.frame}: digest of the state ${answer.digest}${
        same === null ? '' : same ? ' ✓ as stored in this file' : ` ✗ this file has ${linked.digest}`}`;
    $('hash').className = same === false ? 'error' : '';
    document.body.dataset.digest = answer.digest;
}

const host = {
    shown(answer, left) {
        say(left.length ? unsupportedText(answer, left) : '');
        controls.show(answer);
        document.body.dataset.frame = answer.frame;
        const problem = answer.reported.find(({ level }) => level === 'error');
        if (problem)
            say(problem.rendered, true);
    },
    failed: (error, reported) => say(reported.find(({ level }) => level === 'error')?.rendered ?? errorText(error), true),
    ran: rate => controls.ran(rate),
    changed() {
        controls?.refresh();
        clearTimeout(asked);
        if (!dish?.running && dish?.loaded)
            asked = setTimeout(showDigest, 100);
    },
};

// Adds a link to the playground, which can open scripts without files.
function addLink({ link, page, files }) {
    const isAlone = Object.keys(files).length === 0, place = $('links');
    if (!isAlone || link.length > 100000)
        place.textContent = isAlone ? '' : `Files in this page: ${Object.keys(files).join(', ')}`;
    else
        place.append(Object.assign(document.createElement('a'), { href: page + link, textContent: 'Open in the playground' }));
}

async function begin() {
    const data = JSON.parse($('petri-data').textContent);
    if (!data)
        throw new Error("this page contains no script; 'petri link --html' adds one");
    if (globalThis.WebAssembly && !hasSimd())
        throw new Error('this page needs WebAssembly SIMD, which this browser lacks; the playground can run its script');
    linked = await readLink(data.link, Infinity);
    document.title = $('name').textContent = linked.name;
    $('script').textContent = linked.text;
    const [worker, engine] = await Promise.all([unpacked('petri-worker').text(), unpacked('petri-engine').arrayBuffer()]);
    // Not a module, because browsers do not load modules from blobs of local files.
    const url = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
    globalThis.petriWorker = () => new Worker(url);
    $('below').innerHTML = CONTROLS;
    dish = new Dish($('picture'), host, { source: engine });
    const load = async ({ always = false } = {}) =>
        (!always && dish.loaded !== null) || dish.load(linked.text, linked.name, linked.changes);
    controls = new Controls(document, dish, load);
    dish.listen();
    addLink(data);
    await dish.ready;
    for (const [name, content] of Object.entries(data.files))
        await dish.addFile(name, decoded(content));
    await dish.giveFiles();
    const found = await dish.open(linked.text, linked.name, linked);
    if (!found)
        return;
    await showDigest();
    document.body.dataset.verified = String(found.same);
    if (found.same && !matchMedia('(prefers-reduced-motion: reduce)').matches)
        dish.run();
}

begin().catch(error => say(globalThis.DecompressionStream ? error.message : 'This page needs a browser of 2023 or later.', true));

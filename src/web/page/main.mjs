// main.mjs: the playground page: an editor beside a dish, and the actions of the buttons.
import { CONTROLS, Controls } from './controls.mjs';
import { Dish, errorText, unsupportedText } from './dish.mjs';
import { Editor } from './editor.mjs';
import { ScriptSaver, savedScripts } from './saved_scripts.mjs';
import { packLink, readLink } from './link.mjs';
import { Particle } from './particle.mjs';
import { Plot } from './plot.mjs';
import { Problems } from './problems.mjs';
import { Prompt } from './prompt.mjs';
import { SaveDialog, saveAs } from './save.mjs';
import { Table } from './table.mjs';
import { Tabs } from './tabs.mjs';

const $ = id => document.getElementById(id);
const FIRST = 'dish.fl';

const encoder = new TextEncoder();
let editor, dish, controls, problems, prompt, plot, table, particle, samples, help = [], name = FIRST;

function say(text, bad = false) {
    $('message').textContent = text;
    $('message').classList.toggle('error', bad);
}

// --- callbacks of the dish

const host = {
    loaded() {
        say('');
        problems.show([], name);
    },
    shown(answer, left) {
        problems.add(answer.told);
        controls.show(answer);
        prompt.print(answer.log);
        if (answer.picture)
            document.title = answer.picture.title ? `${answer.picture.title} · petri` : 'petri';
        if (left.length)
            say(unsupportedText(answer, left), answer.picture.lost);
        showVerification(answer.verification);
        document.body.dataset.frame = answer.frame;
        look();
    },
    failed(error, told) {
        problems.add(told);
        say(errorText(error), true);
    },
    slow(is) {
        document.body.classList.toggle('busy', is);
    },
    changed() {
        controls.refresh();
    },
    restored() {
        say('');
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
    }, dish.running ? 200 : 0);
}

// Loads the editor's text, unless it is already loaded and `always` is false. Returns false if the text cannot be loaded.
async function ready({ always = false } = {}) {
    const { text } = editor;
    if (!always && dish.loaded === text)
        return true;
    problems.show([], name);
    return dish.load(text, name);
}

// --- the editor's text

const keeper = new ScriptSaver();
let checking = 0, opening = false;
function changed(text) {
    if (!opening) {
        keeper.keep(name, text);
        if (location.hash)
            history.replaceState(null, '', location.pathname + location.search); // the text no longer matches the link
    }
    clearTimeout(checking);
    checking = setTimeout(async () => {
        if (dish.running)
            return;
        const answer = await dish.attempt('check', { text, name });
        if (answer && editor.text === text) {
            problems.show(answer.told, name);
            document.body.dataset.checked = String(answer.told.length);
        }
    }, 250);
}

async function openText(text, called, wanted = {}) {
    name = called;
    keeper.begin();
    opening = true;
    editor.text = text;
    opening = false;
    const opened = await dish.open(text, name, wanted);
    const kind = wanted.digest ? 'digest' : 'SHA-256';
    if (opened?.digest)
        say(opened.same ? `Frame ${wanted.frame}: the state matches the link exactly (${kind} ${opened.digest}).`
            : `Frame ${wanted.frame}: the state differs from the link, probably because another version of petri made the link.`,
        !opened.same);
}

// --- links and files

async function copyLink() {
    const loaded = dish.loaded === editor.text && dish.frame >= 0;
    const answer = loaded ? await dish.attempt('digest') : null;
    const link = await packLink({ text: editor.text, name, ...(answer ?? {}) }).catch(error => say(error.message, true));
    if (!link)
        return;
    history.replaceState(null, '', link);
    const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    say(copied ? 'Link copied. Nothing was uploaded.' : 'The link is in the address bar.');
}

// Opens the script in the page's link. Returns '' on success, or the reason why no script was opened.
async function openLink() {
    if (location.hash.length < 2)
        return 'no link';
    try {
        const linked = await readLink(location.hash);
        await openText(linked.text, linked.name, linked);
        return '';
    } catch (error) {
        say(error.message, true);
        return error.message;
    }
}

const stem = () => name.replace(/\.fl$/, '');

// Replays an archive. Its script is shown in the editor; running a changed script ends the replay.
async function openArchive(file) {
    const script = await dish.replay(new Uint8Array(await file.arrayBuffer()));
    if (!script)
        return;
    name = script.name;
    keeper.begin();
    opening = true;
    editor.text = script.text;
    opening = false;
    dish.run();
}

// Adds scripts and the files that they read. Opens the script that no other script refers to. If there is no such script, restarts the
// current script if it uses the files.
async function takeFiles(files) {
    const archive = [...files].find(file => file.name.endsWith('.petri'));
    if (archive)
        return openArchive(archive);
    for (const file of files)
        await dish.addFile(file.name, new Uint8Array(await file.arrayBuffer()));
    await dish.giveFiles();
    const decoded = [...files].filter(file => file.name.endsWith('.fl'))
        .map(file => ({ called: file.name, text: new TextDecoder().decode(dish.files.get(file.name)) }));
    const isNamed = called => [{ called: name, text: editor.text }, ...decoded]
        .some(other => other.called !== called && other.text.includes(called));
    const script = decoded.find(({ called }) => !isNamed(called));
    if (script)
        await openText(script.text, script.called);
    else if ([...files].some(file => editor.text.includes(file.name)))
        await dish.open(editor.text, name);
}

// Fills the menu with samples and recent scripts.
function fillMenu() {
    const group = (label, options) => {
        const made = Object.assign(document.createElement('optgroup'), { label });
        made.append(...options);
        return options.length ? [made] : [];
    };
    const menu = $('samples'), { value } = menu;
    menu.replaceChildren(new Option('choose…', ''),
        ...group('Samples', Object.keys(samples).map(sample => new Option(sample.replace(/\.fl$/, ''), sample))),
        ...group('Recent scripts', savedScripts().map(({ name: own, when }) =>
            new Option(`${own}, ${new Date(when).toLocaleString()}`, when))));
    menu.value = value;
}

function listen() {
    $('link').onclick = copyLink;
    $('save').onclick = () => saveAs(name, new Blob([editor.text], { type: 'text/plain' }));
    $('open').onclick = () => $('file').click();
    $('file').onchange = () => takeFiles($('file').files);
    $('samples').onchange = () => {
        const chosen = $('samples').value, own = savedScripts().find(({ when }) => String(when) === chosen);
        if (own)
            openText(own.text, own.name);
        else if (chosen)
            openText(samples[chosen], chosen);
    };
    $('samples').onfocus = $('samples').onpointerdown = fillMenu;
    fillMenu();
    $('theme').onclick = () => {
        const dark = getComputedStyle(document.documentElement).colorScheme === 'dark'
            || (!document.documentElement.dataset.theme && matchMedia('(prefers-color-scheme: dark)').matches);
        document.documentElement.dataset.theme = dark ? 'light' : 'dark';
    };
    document.ondragover = event => event.preventDefault();
    document.ondrop = event => {
        event.preventDefault();
        takeFiles(event.dataTransfer.files);
    };
    addEventListener('hashchange', openLink);
}

async function begin() {
    const [before] = savedScripts();
    $('below').innerHTML = CONTROLS;
    dish = new Dish($('picture'), host, globalThis.petriStart ?? { source: new URL('petri/engine.wasm', location.href).href });
    const given = await (await fetch('samples.json')).json();
    samples = given.scripts;
    for (const [file, text] of Object.entries(given.files))
        dish.files.set(file, encoder.encode(text));
    name = before?.name ?? FIRST;
    editor = new Editor($('editor'), {
        text: before?.text ?? samples[FIRST], onChange: changed, onRun: () => controls.toggle(ready), help: () => help,
    });
    problems = new Problems($('problems'), editor);
    prompt = new Prompt(document, dish);
    controls = new Controls(document, dish, ready);
    new SaveDialog(document, dish, stem);
    plot = new Plot(document, dish);
    table = new Table(document, dish);
    const goTo = (file, line, column) => file === name && editor.goTo(line, column);
    particle = new Particle(document, dish, goTo, () => tabs.choose($('tab-particle')));
    const tabs = new Tabs($('tabs'), panel => {
        plot.seen = panel === 'panel-plot';
        particle.seen = panel === 'panel-particle';
        table.seen = panel === 'panel-state';
        look();
    });
    dish.listen();
    listen();
    const answer = await dish.ready.catch(error => say(error.message, true));
    if (!answer)
        return;
    help = answer.help;
    await dish.giveFiles();
    const why = await openLink();
    if (why)
        await openText(editor.text, name);
    if (why && location.hash)
        say(why, true);
    document.body.dataset.ready = answer.version;
    if ('serviceWorker' in navigator && location.protocol !== 'file:')
        navigator.serviceWorker.register('offline.js').catch(() => {});
}

begin();

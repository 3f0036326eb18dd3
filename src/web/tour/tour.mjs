// tour.mjs: a page of the tour: an editor and a dish, and the task of the lesson, which is checked whenever the script changes.
import { engineFile } from '../engine/simd.mjs';
import { CONTROLS, Controls } from '../page/controls.mjs';
import { Dish, errorText, unsupportedText } from '../page/dish.mjs';
import { Editor } from '../page/editor.mjs';
import { Live } from '../page/live.mjs';
import { say } from '../page/message.mjs';
import { Problems } from '../page/problems.mjs';
import { saveAs } from '../page/save.mjs';
import { readSetting, storeSetting } from '../page/settings.mjs';
import { applyTheme, listenForTheme } from '../page/theme.mjs';

const $ = id => document.getElementById(id);
const PLACE = 'petri.tour'; // in the browser's storage: { [name of a lesson]: { text, solved } }
const PAUSE = 300; // ms without an edit after which the task is checked
const NAME = 'tour.fl';

const lesson = JSON.parse($('lesson').textContent);

function stored() {
    try {
        return JSON.parse(readSetting(PLACE)) ?? {};
    } catch {
        return {}; // the text was damaged
    }
}

function keep(changes) {
    const all = stored();
    storeSetting(PLACE, JSON.stringify({ ...all, [lesson.name]: { ...all[lesson.name], ...changes } }));
}

function showSolved() {
    const all = stored();
    for (const item of $('lessons').children)
        item.classList.toggle('solved', !!all[item.dataset.lesson]?.solved);
}

const page = { name: NAME, say };

// Checks the task in a run from frame 0, without the picture.
let waits = 0;
function checkTask() {
    clearTimeout(waits);
    waits = setTimeout(async () => {
        const text = page.editor.text, { frame, check, tree } = lesson;
        const answer = await page.dish.attempt('task', { text, name: NAME, frame, check, tree });
        if (!answer || text !== page.editor.text)
            return;
        $('result').textContent = answer.passed ? '✓ Solved' : '';
        $('task').classList.toggle('solved', answer.passed);
        document.body.dataset.task = answer.passed ? 'solved' : 'open';
        keep(answer.passed ? { text, solved: true } : { text });
        showSolved();
    }, PAUSE);
}

const host = {
    loaded() {
        say('');
        page.problems.show([], NAME);
        page.live.loaded();
    },
    checked: answer => page.live.checked(answer),
    shown(answer, left) {
        page.problems.add(answer.reported);
        page.controls.show(answer);
        if (left.length)
            say(unsupportedText(answer, left), answer.picture.lost);
        document.body.dataset.frame = answer.frame;
    },
    failed(error, reported) {
        page.problems.add(reported);
        say(Live.describe(error) ?? errorText(error), true);
    },
    ran: rate => page.controls.ran(rate),
    changed: () => page.controls?.refresh(),
};

async function show(text) {
    page.editor.text = text;
    if (await page.live.restart())
        page.dish.run();
    checkTask();
}

async function makeFilm() {
    const { dish } = page, progress = $('film-progress');
    dish.pause();
    progress.hidden = false;
    dish.remote.progress = ({ done, of }) => Object.assign(progress, { value: done, max: of });
    const answer = await dish.attempt('save', { kind: 'webm', from: 0, to: lesson.film - 1 });
    progress.hidden = true;
    if (answer)
        saveAs('petri.webm', answer.blob);
}

async function begin() {
    applyTheme();
    listenForTheme($('theme'));
    showSolved();
    $('below').innerHTML = CONTROLS;
    let help = [];
    const worker = new URL('../worker.js', import.meta.url);
    globalThis.petriWorker = () => new Worker(worker, { type: 'module' });
    const dish = page.dish = new Dish($('picture'), host, { source: new URL(`../petri/${engineFile()}`, import.meta.url).href });
    const changed = () => {
        page.live.changed();
        checkTask();
    };
    page.editor = new Editor($('editor'), {
        text: stored()[lesson.name]?.text ?? lesson.start, onChange: changed, onRun: () => page.live.apply().then(() => dish.run()),
        onRestart: () => page.live.restart().then(() => dish.run()), help: () => help,
    });
    page.problems = new Problems($('problems'), page.editor);
    page.live = new Live(page);
    page.controls = new Controls(document, dish, ({ always = false } = {}) => always ? page.live.restart() : page.live.ready());
    dish.listen();
    $('again').onclick = () => show(lesson.start);
    $('solve').onclick = () => show(lesson.solution);
    if ($('film'))
        $('film').onclick = makeFilm;
    ({ help } = await dish.ready);
    await dish.open(page.editor.text, NAME);
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches)
        dish.run();
    checkTask();
    document.body.dataset.ready = 'yes';
    if ('serviceWorker' in navigator && location.protocol !== 'file:') {
        await navigator.serviceWorker.register('../offline.js');
        (await navigator.serviceWorker.ready).active.postMessage('tour/');
    }
}

begin().catch(error => say(error.message, true));

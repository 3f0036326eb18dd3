// browser.mjs: headless Chromium and a server for the tests of the page. Skips the tests if the npm modules or the browser are missing.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
export const folder = process.env.PETRI_WEB;
const browserPath = '/usr/bin/chromium';
const modules = join(root, 'src/web/page/node_modules/playwright-core/index.mjs');
const missing = [modules, browserPath, join(folder, 'page.js')].find(path => !existsSync(path));
export const options = { skip: missing ? `missing: ${missing}` : false, timeout: 60000 };
export const world = { flags: [] }; // browser, its additional flags, server

before(async () => {
    if (missing)
        return;
    const { chromium } = await import(pathToFileURL(modules));
    const { serve } = await import('../../src/web/page/serve.mjs');
    world.server = await serve(folder);
    world.browser = await chromium.launch({
        executablePath: browserPath,
        args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
            '--disable-component-update', '--disable-sync', ...world.flags],
    });
});

after(async () => {
    await world.browser?.close();
    world.server?.close();
});

// Opens a separate page, which must not log messages to the console.
export async function visited(url, { settings = {}, prepare, ready, use, expected = /willReadFrequently/ }) {
    // With reduced motion, scripts do not start by themselves.
    const context = await world.browser.newContext({ viewport: { width: 1200, height: 800 }, reducedMotion: 'reduce', ...settings });
    const page = await context.newPage(), said = [];
    // Ignores the browser's advice about frequent pixel readback.
    page.on('console', message => expected.test(message.text()) || said.push(message.text()));
    page.on('pageerror', error => said.push(error.message));
    await prepare?.(page, context);
    await page.goto(url);
    await page.waitForFunction(ready);
    await use(page, context);
    assert.deepEqual(said, []);
    await context.close();
}

// Playwright's other protocol needs a Firefox of theirs. The unset features cannot be emulated through WebDriver BiDi.
const FIREFOX = '/usr/bin/firefox-esr';
const CONTEXT = { viewport: { width: 1280, height: 800 }, colorScheme: null, reducedMotion: null, forcedColors: null, contrast: null };
export const firefoxOptions = { skip: options.skip || (existsSync(FIREFOX) ? false : `missing: ${FIREFOX}`), timeout: 180000 };

// Opens the page in Firefox, which must not log messages to the console.
export async function openedInFirefox(use, url = world.server.url) {
    const { firefox } = await import(pathToFileURL(modules));
    const browser = await firefox.launch({ executablePath: FIREFOX, channel: 'moz-firefox', headless: true });
    try {
        const page = await (await browser.newContext(CONTEXT)).newPage(), said = [];
        page.setDefaultTimeout(120000);
        page.on('console', message => /willReadFrequently|Service ?Worker/.test(message.text()) || said.push(message.text()));
        page.on('pageerror', error => said.push(error.message));
        await page.goto(url);
        await page.waitForFunction(() => document.body.dataset.ready);
        await use(page);
        assert.deepEqual(said, []);
    } finally {
        await browser.close();
    }
}

export const opened = (hash, how) => visited(world.server.url + hash, { ready: () => document.body.dataset.ready, ...how });

export const frameOf = page => page.evaluate(() => Number(document.body.dataset.frame));
export const atFrame = (page, frame) => page.waitForFunction(wanted => Number(document.body.dataset.frame) === wanted, frame);

// Drags the timeline to a frame.
export async function seek(page, frame) {
    await page.evaluate(wanted => {
        const time = document.getElementById('time');
        time.value = wanted;
        time.dispatchEvent(new Event('input'));
    }, frame);
    await atFrame(page, frame);
}

// A script with a function that takes seconds but no memory. Otherwise, the memory limit would be reached first.
export const SLOW = 'func fib(n)\n    n if n<2 else fib(n-1)+fib(n-2)\n';

// Returns the sum of all bytes of a canvas.
export const pixels = (page, selector = '#picture') => page.locator(selector).first().evaluate(canvas => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i++)
        sum = (sum * 31 + data[i]) % 4294967291;
    return { sum, width: canvas.width, height: canvas.height, all: new Set(data).size };
});

export const says = (page, pattern) => page.waitForFunction(source =>
    new RegExp(source).test(document.getElementById('message').textContent), pattern.source);

// Opens a sample in the gallery.
export async function choose(page, name) {
    await page.click('#scripts');
    await page.click(`#sample-cards button:has(strong:text-is("${name.replace(/\.fl$/, '')}"))`);
}

// Returns the names of the engines that work offline.
export const cachedEngines = page => page.evaluate(async () => {
    const names = await caches.keys(), files = await Promise.all(names.map(async name => (await caches.open(name)).keys()));
    return files.flat().map(({ url }) => url.replace(/.*\//, '')).filter(name => /wasm$/.test(name));
});

export async function typed(page, text) {
    await page.click('.cm-content');
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(text);
}

// Returns the duration of a fixed computation in the page, in milliseconds, with which limits grow on a slow or busy machine. On one
// machine, it took 340 to 400 ms.
export const computationTime = page => page.evaluate(() => {
    const start = performance.now();
    for (let i = 0, sum = 0; i < 3e7; i++)
        sum = (sum * 31 + i) | 0;
    return performance.now() - start;
});

// Checks that a frame for which `wanted(number)` is true is visible within `limit` milliseconds of opening the page with nothing cached.
// `wanted` runs in the page, so it must not use other variables. Takes the best of six attempts, because the machine may be busy. On a slow
// machine, the limit is six times the computation time. On one machine, the dish took 1.7 to 2.0 s (in version 0.2: 2.3 s).
export async function visibleWithin(limit, link, wanted, settings = {}) {
    let best = Infinity, allowed = limit;
    for (let i = 0; i < 6 && best > allowed; i++)
        await opened(link, {
            settings,
            prepare: page => page.addInitScript(`new MutationObserver(() => {
                if ((${wanted})(Number(document.body?.dataset.frame)))
                    globalThis.seenAt ??= performance.now();
            }).observe(document, { attributes: true, subtree: true })`),
            use: async page => {
                await page.waitForFunction(() => globalThis.seenAt);
                best = Math.min(best, await page.evaluate(() => globalThis.seenAt));
                allowed = Math.max(limit, 6 * await computationTime(page));
            },
        });
    assert.ok(best <= allowed, `${best} ms, at most ${allowed} ms`);
}

// offline.test.mjs: the page works offline, can be installed, and is replaced by a new version as a whole.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { appendFileSync, cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { cachedEngines, choose, firefoxOptions, folder, opened, openedInFirefox, options, pixels, root, visited } from './browser.mjs';

const withWorker = page => page.waitForFunction(() => navigator.serviceWorker.controller);
const isReady = page => page.waitForFunction(() => document.body.dataset.ready);

test('a page that was loaded once runs samples, exports and shows a grid offline', options, () => opened('', {
    expected: /Failed to load resource|willReadFrequently/, // pictures of the gallery, which are then computed
    use: async (page, context) => {
        await withWorker(page);
        await page.waitForLoadState('networkidle'); // requests that are under way would fail
        assert.deepEqual(await cachedEngines(page), ['engine.wasm']);
        await context.setOffline(true);
        await page.reload();
        await isReady(page);
        await choose(page, 'springs.fl');
        await page.waitForFunction(() => document.getElementById('name').value === 'springs.fl' && document.body.dataset.frame === '2');
        await page.click('#run');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 8);
        assert.ok((await pixels(page)).all > 3);
        await page.click('#save-as');
        await page.check('#saving input[value=gif]');
        await page.fill('#saving-to', '3');
        const [file] = await Promise.all([page.waitForEvent('download'), page.click('#saving-go')]);
        assert.match(readFileSync(await file.path(), 'latin1'), /^GIF89a/);
        await page.click('#grid-open');
        await page.waitForFunction(() => document.querySelectorAll('#grid td button[data-frame="2"]').length > 0);
    },
}));

test('the page can be installed', options, () => opened('', {
    use: async (page, context) => {
        await withWorker(page);
        const client = await context.newCDPSession(page), { errors, data } = await client.send('Page.getAppManifest');
        assert.deepEqual(errors, []);
        assert.equal(JSON.parse(data).name, 'petri');
        const { installabilityErrors } = await client.send('Page.getInstallabilityErrors');
        // Contexts of tests are like private windows.
        assert.deepEqual(installabilityErrors.map(({ errorId }) => errorId).filter(id => id !== 'in-incognito'), []);
    },
}));

// Makes a version of the page whose files say of which version they are.
const MARKS = {
    'worker.js': version => `;self.version = '${version}';`, 'page.js': version => `;globalThis.ofPage = '${version}';`,
    'start.js': version => `;globalThis.ofStart = '${version}';`, 'style.css': version => `:root { --version: ${version}; }`,
    'index.html': version => `<meta name="version" content="${version}">`,
};
function makeVersion(target, version) {
    const others = /manual|tour|page$|pictures.wasm|command.wasm/;
    cpSync(folder, target, { recursive: true, filter: path => !others.test(path.slice(folder.length)) });
    for (const [file, mark] of Object.entries(MARKS))
        appendFileSync(join(target, file), mark(version));
    const hash = encodeURIComponent(createHash('sha256').update(readFileSync(join(target, 'worker.js'))).digest('base64').slice(0, 8));
    for (const file of ['page.js', 'start.js']) {
        const text = readFileSync(join(target, file), 'utf8');
        assert.match(text, /worker\.js\?v=/);
        writeFileSync(join(target, file), text.replaceAll(/(worker\.js\?v=)[^"']*/g, `$1${hash}`));
    }
    execFileSync(process.execPath, [join(root, 'src/web/page/offline_files.mjs'), target]);
    return hash;
}

// Returns the versions of the files that a page shows, each once.
const versions = async page => {
    await isReady(page);
    return page.evaluate(() => [...new Set([
        document.querySelector('meta[name=version]').content, getComputedStyle(document.documentElement).getPropertyValue('--version'),
        globalThis.ofPage, globalThis.ofStart,
    ])]);
};

// Loads the page again until it shows a version, without ever mixing versions.
async function reloadUntil(page, version) {
    for (let seen = null; seen !== version;) {
        await page.reload();
        const [one, ...others] = await versions(page);
        assert.deepEqual(others, []);
        seen = one;
    }
}

test('a new version replaces the old one as a whole, also in the middle of its deployment', options, async () => {
    const scratch = mkdtempSync(join(tmpdir(), 'petri-')), served = join(scratch, 'served');
    const { serve } = await import('../../src/web/page/serve.mjs');
    const oldHash = makeVersion(served, 'A');
    makeVersion(join(scratch, 'B'), 'B');
    const copy = files => files.forEach(file => cpSync(join(scratch, 'B', file), join(served, file)));
    const server = await serve(served);
    try {
        await visited(server.url, {
            ready: () => document.body.dataset.ready, expected: /404|willReadFrequently|integrity|digest/,
            use: async (page, context) => {
                await withWorker(page);
                await reloadUntil(page, 'A');
                // Some files are new, with and without the list of files.
                for (const files of [['page.js', 'style.css'], ['offline.js']]) {
                    copy(files);
                    for (let i = 0; i < 3; i++) {
                        await page.reload();
                        assert.deepEqual(await versions(page), ['A']);
                        await page.evaluate(async () => (await navigator.serviceWorker.ready).update().catch(() => {}));
                    }
                }
                copy(Object.keys(MARKS));
                await page.evaluate(async () => {
                    const registration = await navigator.serviceWorker.ready;
                    while (!registration.waiting) {
                        await registration.update().catch(() => {});
                        await new Promise(resolve => setTimeout(resolve, 50));
                    }
                });
                // A page that is opened now is of the new version. The other one gets no new worker until it is loaded again.
                const other = await context.newPage();
                await other.goto(server.url);
                await reloadUntil(other, 'B');
                assert.deepEqual(await versions(page), ['A']);
                assert.equal(await page.evaluate(async hash => (await fetch(`worker.js?v=${hash}`)).status, oldHash), 404);
                await reloadUntil(page, 'B');
                await context.setOffline(true);
                await page.reload();
                assert.deepEqual(await versions(page), ['B']);
            },
        });
    } finally {
        server.close();
        rmSync(scratch, { recursive: true });
    }
});

test('in Firefox, a new version replaces the old one, and works without the server', firefoxOptions, async () => {
    const scratch = mkdtempSync(join(tmpdir(), 'petri-')), served = join(scratch, 'served');
    const { serve } = await import('../../src/web/page/serve.mjs');
    makeVersion(served, 'A');
    let server = await serve(served);
    try {
        await openedInFirefox(async page => {
            await withWorker(page);
            await reloadUntil(page, 'A');
            makeVersion(served, 'B');
            await reloadUntil(page, 'B');
            server.close();
            server = null;
            await page.reload();
            assert.deepEqual(await versions(page), ['B']);
        }, server.url);
    } finally {
        server?.close();
        rmSync(scratch, { recursive: true });
    }
});

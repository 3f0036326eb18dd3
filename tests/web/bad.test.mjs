// bad.test.mjs: errors in the page: invalid links, scripts that exceed limits, and browsers that lack required features.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { packLink } from '../../src/web/page/link.mjs';
import { SLOW, atFrame, opened, options, typed, visited, world } from './browser.mjs';

const SQUARE = '!window size=64;32\n    !canvas\n        !rect point=0;0 size=64;32 color=1;0.5;0 fill=true\n';
const said = (page, pattern) => page.waitForFunction(source =>
    new RegExp(source).test(document.getElementById('message').textContent), pattern.source);
const text = page => page.evaluate(() => [...document.querySelectorAll('.cm-line')].map(line => line.textContent).join('\n'));

async function packed(object) {
    const stream = new Blob([JSON.stringify(object)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
    return `#${Buffer.from(await new Response(stream).arrayBuffer()).toString('base64url')}`;
}

const LINKS = 'an invalid link (truncated, too long, from a newer petri, not of petri) is reported and changes nothing';
test(LINKS, options, () => opened('', {
    use: async page => {
        await typed(page, SQUARE);
        await page.waitForFunction(() => document.body.dataset.checked === '0');
        const link = await packLink({ text: SQUARE.replace('64;32', '32;32'), name: 'a.fl', frame: 3, digest: 'f'.repeat(32) });
        const bad = [
            [link.slice(0, -9), /copied completely/], [`#${'A'.repeat(150000)}`, /too long/], ['#%%%', /damaged/],
            [await packed({ v: 2, text: [] }), /newer petri/], [await packed({ v: 1, t: ' '.repeat(5 << 20) }), /more than 4 MiB/],
            [await packed({ v: 1, t: 5 }), /not a petri link/], [await packed(null), /not a petri link/],
        ];
        for (const [hash, message] of bad) {
            await page.evaluate(at => (location.hash = at), hash);
            await said(page, message);
            assert.equal(await text(page), SQUARE);
            assert.ok(await page.evaluate(() => document.getElementById('message').classList.contains('error')));
        }
        const cases = [[bad[0][0], '64;32', /copied completely/], [link, '32;32', /Frame 3: the state differs from the link/]];
        for (const [hash, size, message] of cases) {
            await page.goto('about:blank');
            await page.goto(world.server.url + hash);
            await page.waitForFunction(() => document.body.dataset.ready);
            await said(page, message);
            assert.ok((await text(page)).includes(`size=${size}`));
        }
    },
}));

test('an edited script is kept when a link or another script is opened', options, () => opened('', {
    use: async page => {
        await typed(page, `-- mine\n${SQUARE}`);
        const link = await packLink({ text: SQUARE, name: 'theirs.fl', frame: 2 });
        await page.evaluate(hash => (location.hash = hash), link);
        await page.waitForFunction(() => !document.querySelector('.cm-content').textContent.includes('-- mine'));
        assert.equal(await page.evaluate(() => location.hash), link);
        await page.keyboard.press('Control+Home');
        await page.click('.cm-content');
        await page.keyboard.press('Control+Home');
        await page.keyboard.insertText('-- changed\n');
        assert.equal(await page.evaluate(() => location.hash), '');
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.match(await text(page), /^-- changed\n!window/);
        await page.click('#scripts');
        const own = page.locator('#own-scripts .name');
        assert.equal(await own.count(), 2);
        await own.nth(1).click();
        await page.waitForFunction(() => document.querySelector('.cm-line').textContent === '-- mine');
    },
}));

test('running out of memory is reported and keeps the text', options, () => opened('', {
    use: async page => {
        const greedy = `!a x=..100000000 y=..100000000\n${SQUARE}`;
        await typed(page, greedy);
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => /memory/.test(document.getElementById('problems').textContent));
        assert.match(await page.textContent('#problems'), /too much memory|memory-limit|MiB|GiB/);
        assert.equal(await text(page), greedy);
        await typed(page, SQUARE);
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('picture').width === 64 && document.body.dataset.frame > 3);
    },
}));

// A server without the headers for cross-origin isolation.
const unshared = page => page.route('**/*', async route => {
    const answer = await route.fetch(), headers = answer.headers();
    delete headers['cross-origin-opener-policy'];
    delete headers['cross-origin-embedder-policy'];
    await route.fulfill({ response: answer, headers });
});

test('without shared memory, stop ends the engine, and another one starts', options, () => opened('', {
    settings: { serviceWorkers: 'block' }, prepare: unshared, expected: /willReadFrequently|Service Worker registration blocked/,
    use: async page => {
        assert.equal(await page.evaluate(() => crossOriginIsolated), false);
        await typed(page, `${SLOW}!a x=fib(frame+40)\n${SQUARE}`);
        await page.click('#run');
        await page.waitForSelector('.busy');
        await page.click('#stop');
        await said(page, /^Stopped. Press Run to restart/);
        assert.match(await text(page), /fib/);
        await typed(page, SQUARE); // taken over by the new engine
        await page.waitForFunction(() => document.getElementById('picture').width === 64);
    },
}));

const LOST = [['petri/engine.wasm', /cannot load the engine: .* returned status 404/], ['worker.js', /cannot start the engine/]];
for (const [file, message] of LOST)
    test(`a page that cannot load ${file} reports it and shows the text`, options, () => visited(world.server.url, {
        prepare: page => page.route(`**/${file}*`, route => route.fulfill({ status: 404 })),
        expected: /404|willReadFrequently|MIME|Failed to/,
        ready: () => document.getElementById('message').textContent,
        use: async page => {
            await said(page, message);
            assert.match(await text(page), /^-- A dish/);
            await page.click('#run');
            await page.waitForFunction(() => document.getElementById('message').classList.contains('error'));
        },
    }));

test('a browser without WebAssembly shows the script and the reason why it does not run', options, () => visited(world.server.url, {
    prepare: page => page.addInitScript(() => delete globalThis.WebAssembly),
    ready: () => document.getElementById('message').textContent,
    use: async page => {
        await said(page, /petri needs WebAssembly, which/);
        assert.match(await text(page), /^-- A dish/);
        await typed(page, SQUARE);
        await page.click('#run');
        await said(page, /petri needs WebAssembly, which/);
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
        assert.equal(download.suggestedFilename(), 'dish.fl');
        await page.click('#link');
        await page.waitForFunction(() => location.hash.length > 10);
    },
}));

test('a script of a link cannot read files or use the network', options, async () => {
    const script = "let here=read('/etc/hostname') there=read('http://127.0.0.1:1/x') own=read('samples.json') folder=glob('/etc/*')\n"
        + `!a here=here there=there own=own folder=folder\n${SQUARE}        !image filename='http://127.0.0.1:1/a.png' point=0;0\n`
        + "        !image filename='style.css' point=0;0\n";
    const link = await packLink({ text: script, name: '../../etc/evil.fl', frame: 2 }), asked = [];
    await opened(link, {
        prepare: page => page.on('request', request => asked.push(request.url())),
        use: async page => {
            await atFrame(page, 2);
            await page.fill('#line', 'here;there;own;folder');
            await page.press('#line', 'Enter');
            await page.waitForFunction(() => /\? here[^]*\n[^]*\n/.test(document.getElementById('printed').textContent));
            assert.doesNotMatch(await page.textContent('#printed'), /'/);
        },
    });
    const own = ['', 'start.js', 'page.js', 'style.css', 'samples.json', 'worker.js', 'petri/engine.wasm', 'petri-dish.js', 'offline.js',
        'icon.svg'];
    const others = asked.map(url => url.replace(/[?#].*/, ''))
        .filter(url => !own.some(name => url === world.server.url + name) && !/^(data|blob):/.test(url));
    assert.deepEqual(others, []);
});

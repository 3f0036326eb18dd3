// embed.test.mjs: <petri-dish> in pages on other servers.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { opened, options, pixels, root, visited, world } from './browser.mjs';

const DISH = readFileSync(join(root, 'samples/dish.fl'), 'utf8');
const SQUARE = '!window size=64;32\n    !canvas\n        !rect point=0;0 size=64;32 color=1;(frame/100);0 fill=true\n';
let other, html = '';

// An ordinary server, which does not send petri's headers.
before(() => new Promise(resolve => {
    other = createServer((request, response) => {
        const served = { '/folder/dish.fl': ['text/plain', DISH], '/m.fl': ['text/plain', 'let N=7\n'], '/': ['text/html', html] };
        const [type, text] = served[request.url] ?? [null, ''];
        response.writeHead(type ? 200 : 404, { 'Content-Type': type ?? 'text/plain' }).end(text);
    }).listen(0, '127.0.0.1', resolve);
}));
after(() => other.close());

// Opens a page with this content and waits for the first picture of each element.
function embedded(body, use, how = {}) {
    html = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><title>t</title>
<style>button, canvas, input { border: 9px solid red !important; width: 3px } p { color: rgb(1, 2, 3) }</style>
<script type="module" src="${world.server.url}petri-dish.js"></script><p id="text">text</p><button id="button">b</button>${body}`;
    return visited(`http://127.0.0.1:${other.address().port}/`, {
        ready: () => [...document.querySelectorAll('petri-dish')].every(({ frame }) => frame >= 0), use, ...how,
    });
}

const within = selector => `petri-dish >> ${selector}`;
const shown = (page, frame) => page.waitForFunction(wanted => document.querySelector('petri-dish').frame === wanted, frame);

test('a script from src or from the content runs with controls in a page of another server', options, () => embedded(
    `<petri-dish src="folder/dish.fl" controls></petri-dish><petri-dish class="b"><script type="text/plain">
        ${SQUARE.replaceAll('\n', '\n        ')}
    </script></petri-dish>`, async page => {
        const first = await pixels(page, within('#picture'));
        assert.ok(first.width > 100 && first.all > 20, JSON.stringify(first));
        const [r, g, b] = await page.locator('petri-dish.b >> #picture')
            .evaluate(canvas => canvas.getContext('2d').getImageData(30, 10, 1, 1).data);
        assert.deepEqual([r, g, b], [255, 5, 0]);
        assert.equal(await page.evaluate(() => globalThis.crossOriginIsolated), false);
        await page.click(within('#run'));
        await page.waitForFunction(() => document.querySelector('petri-dish').frame > 12);
        await page.click(within('#run'));
        await page.locator(within('#time')).first().fill('2');
        await shown(page, 2);
        assert.equal((await pixels(page, within('#picture'))).sum, first.sum);
        await page.click(within('#step'));
        await shown(page, 3);
        assert.notEqual((await pixels(page, within('#picture'))).sum, first.sum);
        assert.ok(await page.locator(within('#parameters input')).count() > 0);
        assert.ok(await page.locator('petri-dish.b >> #run').isHidden());
    }));

test('styles of the page and of the element do not affect each other', options, () => embedded(
    `<petri-dish src="folder/dish.fl" controls></petri-dish>`, async page => {
        const style = (selector, name) => page.locator(selector).first().evaluate((element, of) => getComputedStyle(element)[of], name);
        assert.equal(await style('#text', 'color'), 'rgb(1, 2, 3)');
        assert.equal(await style('#button', 'borderTopWidth'), '9px');
        assert.equal(await style(within('#run'), 'borderTopWidth'), '1px');
        assert.equal(await style(within('#picture'), 'borderTopWidth'), '0px');
        const added = await page.evaluate(() =>
            [document.title, document.head.children.length, document.querySelectorAll('petri-dish > *').length]);
        assert.deepEqual(added, ['t', 5, 0]);
    }));

test('the reader can change the script and gets a link to the changed one', options, () => embedded(
    `<petri-dish controls editor frame="7"><pre>${SQUARE}</pre></petri-dish>`, async (page, context) => {
        await shown(page, 7);
        const text = page.locator(within('#text'));
        assert.equal(await text.inputValue(), SQUARE);
        await text.fill(SQUARE.replace('size=64;32\n', 'size=40;20\n'));
        await text.press('Control+Enter');
        await page.waitForFunction(() => document.querySelector('petri-dish').shadowRoot.getElementById('picture').width === 40);
        await page.waitForFunction(() => document.querySelector('petri-dish').running && document.querySelector('petri-dish').frame > 3);
        await page.click(within('#run'));
        await text.fill('!a x=)\n');
        await page.click(within('#run'));
        await page.waitForFunction(() =>
            /script\.fl:1:6: error/.test(document.querySelector('petri-dish').shadowRoot.getElementById('message').textContent));
        await text.fill(SQUARE.replace('size=64;32\n', 'size=40;20\n'));
        const [linked] = await Promise.all([context.waitForEvent('page'), page.click(within('#open'))]);
        await linked.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await linked.evaluate(() => document.getElementById('picture').width), 40);
    }));

test('a page can control the element and receives its events', options, () => embedded(
    `<petri-dish src="nothing.fl"></petri-dish><script>
        globalThis.heard = [];
        for (const type of ['petri-ready', 'petri-frame', 'petri-error'])
            document.addEventListener(type, event => heard.push([type, event.detail]));
    </script>`, async page => {
        await page.waitForFunction(() => globalThis.heard.some(([type]) => type === 'petri-error'));
        assert.match(await page.textContent(within('#message')), /cannot read nothing\.fl: the server returned status 404/);
        const done = await page.evaluate(async script => {
            const dish = document.createElement('petri-dish');
            dish.setAttribute('files', 'm.fl');
            dish.textContent = script;
            document.querySelector('petri-dish').replaceWith(dish);
            await new Promise(resolve => dish.addEventListener('petri-ready', resolve));
            await dish.seek(9);
            await dish.set('A', 5);
            await dish.seek(12);
            const { frame, running } = dish;
            dish.run();
            const pictures = globalThis.heard.filter(([type]) => type === 'petri-frame');
            return { frame, running, frames: pictures.map(([, detail]) => detail.frame) };
        }, "import N from 'm.fl'\nlet A=A or N\n!window size=8;8\n    !canvas\n        !rect size=A;8 fill=true\n");
        assert.deepEqual([done.frame, done.running], [12, false]);
        assert.deepEqual(done.frames, [0, 2, 9, 9, 12]);
        await page.waitForFunction(() => document.querySelector('petri-dish').frame > 14);
        await page.evaluate(() => document.querySelector('petri-dish').remove());
    }, { ready: () => document.querySelector('petri-dish'), expected: /404|willReadFrequently/ }));

test('the page of petri itself can contain the element', options, () => opened('', {
    use: async page => {
        await page.evaluate(async () => {
            await import('./petri-dish.js');
            document.body.append(Object.assign(document.createElement('petri-dish'), { textContent: '!window size=9;9\n    !canvas\n' }));
        });
        await page.waitForFunction(() => document.querySelector('petri-dish').frame === 2);
    },
}));

test('the script is shown in colours exactly behind the letters that the reader types', options, () => embedded(
    `<petri-dish editor><pre>${SQUARE}</pre></petri-dish>`, async page => {
        const seen = () => page.evaluate(() => {
            const { shadowRoot } = document.querySelector('petri-dish');
            const [text, colours] = ['text', 'colours'].map(id => shadowRoot.getElementById(id));
            const place = element => {
                const { font, padding, tabSize, borderWidth } = getComputedStyle(element);
                const { x, y, width, height } = element.getBoundingClientRect();
                return [font, padding, tabSize, borderWidth, x, y, width, height, element.scrollLeft, element.scrollTop];
            };
            const words = [...colours.querySelectorAll('span')].map(({ textContent, style }) => [textContent, style.color]);
            const same = colours.textContent === `${text.value}\n`;
            return { same, places: [place(text), place(colours)], words, color: getComputedStyle(text).color };
        });
        const first = await seen(), colour = word => first.words.find(([text]) => text === word)[1];
        assert.ok(first.same && first.words.length > 8);
        assert.equal(first.color, 'rgba(0, 0, 0, 0)');
        assert.notEqual(colour('!window'), colour('64'));
        assert.deepEqual(first.places[0], first.places[1]);
        const text = page.locator(within('#text')), long = `-- ${'x'.repeat(400)}\n${'let A=\'<b>&\'\n'.repeat(60)}`;
        await text.fill(long);
        await text.evaluate(element => element.scrollTo(300, 400));
        await page.waitForFunction(() => document.querySelector('petri-dish').shadowRoot.getElementById('colours').scrollTop > 0);
        const then = await seen();
        assert.ok(then.same && then.places[0].at(-1) > 0 && then.places[0].at(-2) > 0);
        assert.deepEqual(then.places[0], then.places[1]);
    }));

test('warnings are only shown to readers who can edit the script', options, () => embedded(
    ['editor', ''].map((given, i) =>
        `<petri-dish id="d${i}" ${given}><pre>!window size=9;9\n    !canvas\n        !rect sice=9\n</pre></petri-dish>`).join(''),
    async page => {
        const message = id => page.locator(`#d${id} >> #message`).textContent();
        assert.match(await message(0), /^script\.fl:3:15: warning: !rect: .*'sice'[^]*\^~~~/);
        assert.equal(await message(1), '');
        await page.locator('#d0 >> #text').fill('!window size=9;9\n    !canvas color=1\n        !rect size=9 fill=true\n');
        await page.locator('#d0 >> #text').press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('d0').running);
        assert.equal(await message(0), '');
    }));

test('nodes that need WebGL 2 are reported below the picture', options, () => embedded(
    '<petri-dish><pre>!window size=64;32\n    !bloom radius=2\n        !canvas\n</pre></petri-dish>', async page => {
        assert.equal(await page.textContent(within('#message')), 'Not drawn: bloom. This browser does not support WebGL 2.');
    }, {
        prepare: page => page.route('**/worker.js*', async route => {
            const response = await route.fetch();
            await route.fulfill({ response, body: `OffscreenCanvas.prototype.getContext = (get => function (kind, ...more) {
                return kind === 'webgl2' ? null : get.call(this, kind, ...more); })(OffscreenCanvas.prototype.getContext);
                ${await response.text()}` });
        }),
    }));

for (const reducedMotion of ['no-preference', 'reduce'])
    test(`autoplay respects the preference for motion: ${reducedMotion}`, options, () => embedded(
        `<petri-dish autoplay label="what it is"><pre>${SQUARE}</pre></petri-dish>`, async page => {
            assert.equal(await page.locator(within('#picture')).getAttribute('aria-label'), 'what it is');
            if (reducedMotion === 'reduce') {
                await shown(page, 2);
                assert.equal(await page.evaluate(() => document.querySelector('petri-dish').running), false);
                await page.click(within('#start'));
            }
            await page.waitForFunction(() => document.querySelector('petri-dish').frame > 5);
        }, { settings: { reducedMotion } }));

test('without autoplay it waits for a click', options, () => embedded(`<petri-dish><pre>${SQUARE}</pre></petri-dish>`, async page => {
    await shown(page, 2);
    await page.waitForTimeout(300);
    assert.deepEqual(await page.evaluate(() => [document.querySelector('petri-dish').running, document.querySelector('petri-dish').frame]),
        [false, 2]);
}));

test('the engine is loaded once, starts when an element comes into view, and pauses out of view', options, async () => {
    const asked = [];
    await embedded(`<petri-dish id="a"><pre>${SQUARE}</pre></petri-dish><div style="height: 5000px"></div>
        <petri-dish id="b"><pre>${SQUARE}</pre></petri-dish>`, async page => {
        const frame = id => page.evaluate(name => document.getElementById(name).frame, id);
        assert.equal(await frame('b'), -1);
        await page.evaluate(() => document.getElementById('a').run());
        await page.waitForFunction(() => document.getElementById('a').frame > 4);
        await page.evaluate(() => document.getElementById('b').scrollIntoView());
        await page.waitForFunction(() => document.getElementById('b').frame === 2 && !document.getElementById('a').running);
        const rested = await frame('a');
        await page.evaluate(() => scrollTo(0, 0));
        await page.waitForFunction(before => document.getElementById('a').frame > before, rested);
        assert.equal(asked.filter(url => url.endsWith('engine.wasm')).length, 1);
    }, {
        ready: () => document.getElementById('a')?.frame >= 0,
        prepare: page => page.on('request', request => asked.push(request.url())),
    });
});

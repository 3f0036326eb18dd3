// page.test.mjs: tests the page in headless Chromium by user input.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import {
    SLOW, atFrame, choose, folder, frameOf, opened, options, pixels, root, seek, typed, visibleWithin, visited, world,
} from './browser.mjs';

const DISH = readFileSync(join(root, 'samples/dish.fl'), 'utf8');

// The grid and the exports are loaded when they are used.
test('the page is small', options, () => {
    const sizeOf = name => gzipSync(readFileSync(join(folder, name)), { level: 9 }).length;
    const files = ['index.html', 'style.css', 'start.js', 'page.js', 'worker.js', 'samples.json'];
    const size = files.reduce((sum, name) => sum + sizeOf(name), 0);
    assert.ok(size <= 1.95e5 && size + sizeOf('petri/engine.wasm') <= 1.5e6, `${size} bytes without the engine`);
});

test('a linked dish is visible within 1.5 seconds, with nothing cached', options, async () => {
    const { packLink } = await import('../../src/web/page/link.mjs');
    await visibleWithin(1500, await packLink({ text: DISH, name: 'dish.fl', frame: 3 }), frame => frame === 3);
});

test('going back and forth shows the same pictures again', options, () => opened('', {
    use: async page => {
        assert.equal(await frameOf(page), 2);
        const first = await pixels(page);
        assert.ok(first.width > 100 && first.all > 20, JSON.stringify(first));
        await page.click('#run');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 45);
        assert.equal(await page.textContent('#run'), 'Pause');
        await page.click('#run');
        const end = await page.waitForFunction(() => document.getElementById('run').textContent === 'Run' && document.body.dataset.frame);
        const last = Number(await end.jsonValue()), seen = new Map();
        for (const frame of [last, 31, 2, 44, 31, 2]) {
            await seek(page, frame);
            const { sum } = await pixels(page);
            assert.equal(seen.get(frame) ?? sum, sum, `frame ${frame}`);
            seen.set(frame, sum);
        }
        assert.equal(seen.get(2), first.sum);
        assert.equal(new Set(seen.values()).size, 4);
        await page.click('#step');
        await atFrame(page, 3);
        await page.click('#back');
        await atFrame(page, 2);
        assert.equal((await pixels(page)).sum, first.sum);
        await page.click('#reset');
        await atFrame(page, 0);
    },
}));

const centre = page => page.evaluate(() => [...document.getElementById('picture').getContext('2d').getImageData(32, 16, 1, 1).data]);

test('pictures with and without effects can replace each other', options, () => opened('', {
    use: async page => {
        const flat = '!window size=64;32\n    !canvas\n        !rect size=64;32 color=1;0.5;0 fill=true\n';
        const effect = '!window size=64;32\n    !vignette inset=0\n        !canvas\n            !rect size=64;32 color=0;0;1 fill=true\n';
        const seen = [];
        for (const script of [flat, effect, flat]) {
            await page.evaluate(() => delete document.body.dataset.frame);
            await typed(page, script);
            await page.click('#reset');
            await atFrame(page, 0);
            seen.push(await centre(page));
        }
        assert.equal(await page.textContent('#message'), '');
        assert.deepEqual([seen[0], seen[2]], [[255, 128, 0, 255], [255, 128, 0, 255]]);
        assert.ok(seen[1][0] < 5 && seen[1][2] > 200, `${seen[1]}`);
    },
}));

test('the speed menu sets the number of frames per second', options, () => opened('', {
    use: async page => {
        await typed(page, '!window size=8;8\n    !canvas\n');
        await page.click('#reset');
        await atFrame(page, 0);
        const frames = await page.evaluate(async () => {
            const $ = id => document.getElementById(id), waiting = [], counts = [];
            let now = 1000;
            performance.now = () => now;
            globalThis.requestAnimationFrame = callback => waiting.push(callback);
            // 64 ticks are exactly one second. Each tick comes after the frames of the previous one.
            const tick = async () => {
                while (waiting.length === 0)
                    await new Promise(resolve => setTimeout(resolve));
                now += 15.625;
                waiting.splice(0).forEach(callback => callback(now));
            };
            const drawn = async count => {
                while (waiting.length === 0 && $('run').textContent === 'Pause')
                    await new Promise(resolve => setTimeout(resolve));
                return Number(document.body.dataset.frame) - count;
            };
            for (const { value } of $('speed').options) {
                $('speed').value = value;
                $('speed').dispatchEvent(new Event('change'));
                const before = await drawn(0);
                $('run').click();
                await new Promise(resolve => setTimeout(resolve));
                for (let i = 0; i < 64; i++)
                    await tick();
                counts.push([value, await drawn(before)]);
                $('run').click();
                waiting.length = 0;
            }
            return counts;
        });
        assert.deepEqual(frames, [['0.25', 15], ['0.5', 30], ['1', 60], ['2', 120], ['4', 240]]);
    },
}));

const withoutWebgl = page => page.route('**/worker.js*', async route => {
    const response = await route.fetch(), get = 'OffscreenCanvas.prototype.getContext';
    const without = `const get = ${get};
        ${get} = function (kind, ...more) { return kind === 'webgl2' ? null : get.call(this, kind, ...more); };`;
    route.fulfill({ response, body: without + await response.text() });
});

test('without WebGL 2 the page reports it and draws the rest', options, () => opened('', {
    prepare: withoutWebgl,
    use: async page => {
        await typed(page, '!window size=64;32\n    !bloom radius=2\n        !canvas\n'
            + '            !rect size=64;32 color=1;0.5;0 fill=true\n');
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('picture').width === 64);
        assert.equal(await page.textContent('#message'), 'Not drawn: bloom. This browser does not support WebGL 2.');
        const at = await page.evaluate(() => [...document.getElementById('picture').getContext('2d').getImageData(30, 10, 1, 1).data]);
        assert.deepEqual(at, [255, 128, 0, 255]);
    },
}));

test('without WebGL 2, a 3-D script shows its particles in two dimensions', options, () => opened('', {
    prepare: withoutWebgl,
    use: async page => {
        await typed(page, '!physics state=:world dimensions=2\n    !particle id=0 radius=9 position=0;0 velocity=90;0\n'
            + '!window size=64;32\n    !canvas3d\n        !sphere position=$(:world;0);0\n');
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('message').textContent.includes('canvas3d'));
        assert.equal(await page.textContent('#message'), 'Not drawn: canvas3d, sphere. This browser does not support WebGL 2.');
        await page.click('#step');
        await page.waitForFunction(() => {
            const { width, height } = document.getElementById('picture');
            const { data } = document.getElementById('picture').getContext('2d').getImageData(0, 0, width, height);
            return new Set(data).size > 3;
        });
    },
}));

test('an error is marked in the text while typing', options, () => opened('', {
    use: async page => {
        await typed(page, '!window size=100;100\n    !canvas color=1\n        !rect size=coss(1) fill=true\n');
        await page.waitForSelector('.cm-lintRange-warning');
        assert.equal(await page.textContent('.cm-lintRange-warning'), 'coss');
        assert.match(await page.textContent('#problems'), /3:20: warning: unbound name 'coss'.*did you mean 'cos'/);
        await typed(page, '!a x=1)\n');
        await page.waitForSelector('.cm-lintRange-error');
        await page.click('#run');
        await page.waitForSelector('#message.error');
        assert.equal(await page.textContent('#message'), '1 error: the last version without errors is shown.');
        assert.match(await page.textContent('#problems'), /^1:7: error: /);
        await typed(page, '!window size=64;32\n    !canvas\n        !rect point=0;0 size=64;32 color=1;0.5;0 fill=true\n');
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('picture').width === 64);
        const colour = await page.evaluate(() => [...document.getElementById('picture').getContext('2d').getImageData(30, 10, 1, 1).data]);
        assert.deepEqual(colour, [255, 128, 0, 255]);
        assert.equal(await page.textContent('#problems'), '');
    },
}));

test('a slider changes a parameter, and a link restores everything', options, () => opened('', {
    use: async (page, context) => {
        const [slider] = await page.$$('#parameters input[type=range]');
        const before = (await pixels(page)).sum;
        const name = (await slider.getAttribute('aria-label')).split(':')[0];
        await slider.focus();
        await page.keyboard.press('Home');
        for (let frame = 3; frame < 8; frame++) {
            await page.click('#step');
            await atFrame(page, frame);
        }
        const changed = (await pixels(page)).sum, value = await page.inputValue(`#parameter-${name}`);
        assert.notEqual(changed, before);
        await page.click('#link');
        await page.waitForFunction(() => location.hash.length > 1);
        const hash = await page.evaluate(() => location.hash);
        const other = await context.newPage();
        await other.goto(world.server.url + hash);
        await other.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await frameOf(other), 7);
        assert.match(await other.textContent('#message'), /the state matches the link exactly/);
        assert.equal((await pixels(other)).sum, changed);
        assert.equal(await other.inputValue(`#parameter-${name}`), value);
        assert.equal(await other.textContent('#problems'), '');
    },
}));

test('an invalid link is reported and changes nothing', options, async () => {
    const { SPEC, packLink, readLink } = await import('../../src/web/page/link.mjs');
    const link = await packLink({ text: DISH, name: 'dish.fl', frame: 3, digest: 'f'.repeat(32), changes: [[1, 'A', '2']] });
    assert.match(link, /^#[A-Za-z0-9_-]+$/);
    assert.deepEqual(await readLink(link),
        { text: DISH, name: 'dish.fl', frame: 3, digest: 'f'.repeat(32), hash: null, changes: [[1, 'A', '2']], spec: SPEC });
    await assert.rejects(readLink(link.slice(0, -9)), /copied completely/);
    await assert.rejects(readLink('#!!'), /damaged/);
    await assert.rejects(readLink(`#${'A'.repeat(200000)}`), /too long/);
    await assert.rejects(readLink(await packLink({ text: 7 })), /not a petri link/);
    await assert.rejects(packLink({ text: Array.from({ length: 90000 }, (_, i) => Math.sin(i)).join(' ') }), /too long for a link/);
    await opened(await packLink({ text: DISH, name: 'dish.fl', frame: 3, digest: 'f'.repeat(32) }), {
        use: async page => {
            assert.match(await page.textContent('#message'), /the state differs from the link/);
            await page.evaluate(() => (location.hash = '#AAAA'));
            await page.waitForSelector('#message.error');
            await page.waitForFunction(() => /damaged|not a petri link/.test(document.getElementById('message').textContent));
            assert.ok((await page.textContent('.cm-content')).length > 100);
        },
    });
});

// Returns the number of pixels that differ from a PNG by more than 5 % in a channel.
const differing = (page, png) => page.evaluate(async url => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.getElementById('picture'), { width, height } = canvas;
    if (image.width !== width || image.height !== height)
        return width * height;
    const other = new OffscreenCanvas(width, height).getContext('2d');
    other.drawImage(image, 0, 0);
    const a = canvas.getContext('2d').getImageData(0, 0, width, height).data, b = other.getImageData(0, 0, width, height).data;
    let count = 0;
    for (let i = 0; i < a.length; i += 4)
        count += Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2])) > 13;
    return count / (width * height);
}, `data:image/png;base64,${png.toString('base64')}`);

// The frame that `petri render --frames 1` saves: the first in which particles are at their positions.
const PICTURES = { aquarium: 2, barriers: 0, beads: 2, clockwork: 0, dish: 2, hello: 2, springs: 2, terrain: 0, trails: 2 };
const petri = join(root, 'build/src/petri-pictures');
const drawn = { ...options, skip: options.skip || (existsSync(petri) ? false : `missing: ${petri}`) };

test('pictures of the samples equal those of petri render, except at edges', drawn, () => opened('', {
    use: async page => {
        for (const [name, frame] of Object.entries(PICTURES)) {
            const scratch = join(mkdtempSync(join(tmpdir(), 'petri-')), 'a.png');
            execFileSync(petri, ['render', join(root, `samples/${name}.fl`), '--frames', '1', '-o', scratch, '--quiet']);
            await page.evaluate(() => delete document.body.dataset.frame);
            await choose(page, name);
            await atFrame(page, 2);
            if (frame === 0) {
                await page.click('#reset');
                await atFrame(page, 0);
            }
            const part = await differing(page, readFileSync(scratch));
            rmSync(dirname(scratch), { recursive: true });
            assert.ok(part < 0.01, `${name}: ${part} of its pixels`);
        }
    },
}));

test('deep recursion does not end the engine in a worker', options, () => opened('', {
    use: async page => {
        const names = Array.from({ length: 40 }, (_, i) => `f${i}`), nested = '(1+' + '(2*'.repeat(150), end = ')'.repeat(151);
        const functions = names.map((name, i) => `func ${name}(fs, n)\n    ${nested}fs[${(i + 1) % 40}](fs, n-1)${end} if n>0 else 0\n`);
        await typed(page, `${functions.join('')}let fs=${names.join(';')}\n!a x=f0(fs, 9000)\n!window size=48;16\n    !canvas\n`);
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('picture').width === 48);
        assert.match(await page.textContent('#problems'), /recursion too deep/);
    },
}));

test('the page fits a phone, a laptop and a large screen', options, async () => {
    for (const [width, height] of [[390, 844], [1280, 800], [1920, 1080]])
        await opened('', {
            settings: { viewport: { width, height } },
            use: async page => {
                if (process.env.SHOTS)
                    await page.screenshot({ path: `${process.env.SHOTS}/page-${width}.png` });
                assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, `${width} pixels`);
                for (const selector of ['#picture', '#run', '#editor']) {
                    const box = await page.locator(selector).boundingBox();
                    assert.ok(box.x >= 0 && box.width > 20 && box.x + box.width <= width, `${selector} at ${width} pixels`);
                }
            },
        });
});

test('axe finds no serious problems, in dark and light', { ...options, timeout: 180000 }, async () => {
    const axe = readFileSync(join(root, 'src/web/page/node_modules/axe-core/axe.min.js'), 'utf8');
    for (const colorScheme of ['light', 'dark'])
        await opened('', {
            settings: { colorScheme },
            use: async page => {
                await page.evaluate(axe);
                const violations = [], look = async () => violations.push(...(await page.evaluate(rules => globalThis.axe.run(rules),
                    colorScheme === 'light' ? {} : { runOnly: ['color-contrast'] })).violations);
                await look();
                await page.click('#tab-plot');
                await page.fill('#watch-line', 'frame');
                await page.press('#watch-line', 'Enter');
                await look();
                await page.click('#tab-state');
                await page.waitForSelector('#state-rows td');
                await look();
                await page.click('#save-as');
                await look();
                await page.keyboard.press('Escape');
                await page.click('#new');
                await page.click('#scripts');
                await page.click('[aria-label="Duplicate script.fl"]');
                await page.click('#scripts');
                await page.click('[aria-label="Delete script.fl"]');
                await look();
                await page.keyboard.press('Escape');
                await page.evaluate(async () => {
                    await import('./petri-dish.js');
                    document.body.innerHTML = '<main><h1>t</h1><petri-dish controls editor>let A=A or 1 -- 1..2\n'
                        + '!window size=9;9\n    !canvas\n</petri-dish></main>';
                });
                await page.waitForFunction(() => document.querySelector('petri-dish').frame === 2);
                await look();
                const bad = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
                assert.deepEqual(bad.map(({ id, nodes }) => [colorScheme, id, nodes.map(node => node.html.slice(0, 120))]), []);
            },
        });
});

test('a long frame can be stopped, and the script continues from the previous frame', options, () => opened('', {
    use: async page => {
        assert.ok(await page.evaluate(() => crossOriginIsolated));
        await typed(page, SLOW + 'let LONG=LONG or 1 -- 1..2\n!window size=64;8\n    !canvas\n        '
            + '!rect size=(fib(frame+31) if frame==9 and LONG==1 else frame);8 fill=true\n');
        await page.click('#run');
        await page.waitForFunction(() => document.querySelector('.busy'));
        await page.click('#stop');
        await page.waitForFunction(() => document.getElementById('message').textContent === 'Stopped. The previous frame is shown.');
        await atFrame(page, 8);
        const { sum } = await pixels(page);
        await page.click('#back');
        await atFrame(page, 7);
        await page.fill('#parameter-LONG', '2');
        await page.press('#parameter-LONG', 'Enter');
        await page.click('#step');
        await atFrame(page, 8);
        assert.equal((await pixels(page)).sum, sum);
        await page.click('#step');
        await atFrame(page, 9);
    },
}));

test('an endless frame can be stopped, and the text is kept', options, () => opened('', {
    use: async page => {
        const text = `${SLOW}!a x=fib(frame+40)\n`;
        await typed(page, text);
        await page.click('#run');
        await page.click('#stop');
        await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('Stopped'));
        assert.equal(await page.evaluate(() => document.querySelector('.cm-line').textContent), SLOW.split('\n')[0]);
        await typed(page, '!window size=32;32\n    !canvas\n');
        await page.click('#run');
        await page.waitForFunction(() => document.getElementById('picture').width === 32);
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await page.evaluate(() => document.querySelector('.cm-line').textContent), '!window size=32;32');
    },
}));

test('the prompt, samples, keyboard, themes and offline use work', options, () => opened('', {
    use: async (page, context) => {
        await page.fill('#line', '1+2');
        await page.press('#line', 'Enter');
        await page.waitForFunction(() => /\? 1\+2\n3\n/.test(document.getElementById('printed').textContent));
        for (const name of ['aquarium.fl', 'springs.fl', 'orbits.fl', 'barriers.fl']) {
            await page.evaluate(() => delete document.body.dataset.frame);
            await choose(page, name);
            await page.waitForFunction(() => document.body.dataset.frame === '2');
            assert.equal(await page.textContent('#problems'), '', name);
            assert.ok((await pixels(page)).all > 3, name);
        }
        await page.focus('#run');
        await page.keyboard.press('Space');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 6);
        await page.keyboard.press('Space');
        const back = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const light = await back();
        await page.click('#theme');
        assert.notEqual(await back(), light);
        await page.waitForFunction(() => navigator.serviceWorker.controller);
        await context.setOffline(true);
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        const offline = Number(await page.evaluate(() => document.body.dataset.frame));
        await page.focus('#run');
        await page.keyboard.press('Space');
        await page.waitForFunction(min => Number(document.body.dataset.frame) > min, offline + 4);
        assert.ok((await pixels(page)).all > 3);
    },
}));

test('the page of `petri view` in Node.js moves, also after a change of the file', options, async () => {
    const { serveScript } = await import(pathToFileURL(join(folder, 'petri/view.mjs')));
    const work = mkdtempSync(join(tmpdir(), 'petri-view-')), script = join(work, 'a.fl');
    const text = colour => `!window size=64;32\n    !canvas\n        !rect size=64;32 color=${colour} fill=true\n`;
    writeFileSync(script, text('1;0;0'));
    const { url, close } = await serveScript(script);
    const moves = (page, wanted) => page.waitForFunction(([r, g, b]) => {
        const [red, green, blue] = document.getElementById('picture').getContext('2d').getImageData(32, 16, 1, 1).data;
        return red === r && green === g && blue === b && Number(document.body.dataset.frame) > 5;
    }, wanted);
    try {
        for (const settings of [{ reducedMotion: 'no-preference' }, {}])
            await visited(url, {
                settings, ready: () => document.body.dataset.ready,
                use: async page => {
                    if (!settings.reducedMotion)
                        return assert.equal(await frameOf(page), 2); // reduced motion is respected
                    await moves(page, [255, 0, 0]);
                    writeFileSync(script, text('0;0;1'));
                    await moves(page, [0, 0, 255]);
                    return page.reload().then(() => moves(page, [0, 0, 255]));
                },
            });
    } finally {
        close();
        rmSync(work, { recursive: true });
    }
});

// grid.test.mjs: the grid of dishes with other values of two parameters.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { firefoxOptions, frameOf, opened, openedInFirefox, options, root, says, typed } from './browser.mjs';

const petri = join(root, 'build/src/petri');
const beside = { ...options, skip: options.skip || (existsSync(petri) ? false : `missing: ${petri}`) };

// Particles whose state depends on all three parameters.
const SCRIPT = `let MASS=MASS or 2 -- 1..4
    PUSH=PUSH or 5 -- 1..10
    HEAT=HEAT or 3 -- 1..9
!physics state=:p dimensions=2
    !particle id=0 position=100;50 velocity=PUSH;0 mass=MASS
    !random strength=HEAT
!window size=200;100
    !canvas
        !ellipse point=($(:p;0) or 100;50) radius=10*MASS color=1;PUSH/10;0 fill=true
        !rect point=(3*frame);90 size=10;10 color=1 fill=true
`;

async function loaded(page, text) {
    await typed(page, text);
    await page.waitForFunction(() => document.getElementById('picture').width === 200);
}

// Opens the grid, which has a dish for each of `count` values at frame 2 or later.
async function gridOf(page, count) {
    await page.click('#grid-open');
    await page.waitForFunction(wanted => {
        const cells = [...document.querySelectorAll('#grid td button')];
        return cells.length === wanted && cells.every(({ dataset }) => Number(dataset.frame) >= 2);
    }, count);
}
const reach = (page, frame) => page.waitForFunction(wanted =>
    Number(document.querySelector('#grid td button').dataset.frame) >= wanted, frame);

// Returns the sum of the bytes of each dish.
const sums = page => page.evaluate(() => [...document.querySelectorAll('#grid canvas')].map(canvas => {
    const context = new OffscreenCanvas(40, 20).getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0, 40, 20);
    return context.getImageData(0, 0, 40, 20).data.reduce((sum, byte) => (sum * 31 + byte) % 4294967291, 0);
}));

test('a dish of the grid has the state that the page and the command have with its values', beside, () => opened('', {
    use: async page => {
        await loaded(page, SCRIPT);
        await page.fill('#parameter-HEAT', '7'); // the other parameters keep their values
        await page.press('#parameter-HEAT', 'Enter');
        await gridOf(page, 16);
        await page.selectOption('#grid-across-count', '3');
        await page.selectOption('#grid-down-count', '2');
        await page.fill('#grid-down-from', '2');
        await page.press('#grid-down-from', 'Enter');
        await page.waitForFunction(() => document.querySelectorAll('#grid td button').length === 6);
        const heads = await page.locator('#grid th').allTextContents();
        assert.deepEqual(heads, ['1', '3', '4', '2', '10']); // 2.5 is rounded, as MASS has whole values
        await page.click('#grid-run');
        await reach(page, 12);
        const dish = page.locator('#grid tbody tr:nth-child(2) td:nth-child(3) button');
        assert.equal(await dish.getAttribute('aria-label'), 'MASS 3, PUSH 10');
        await dish.click();
        await says(page, /^MASS 3, PUSH 10: the state of frame \d+ is that in the grid\.$/);
        assert.ok(await page.isHidden('#grid'));
        await page.click('#run'); // it runs, as the grid did
        await page.waitForFunction(() => document.getElementById('run').textContent === 'Run');
        assert.deepEqual(await Promise.all(['MASS', 'PUSH', 'HEAT'].map(name => page.inputValue(`#parameter-${name}`))), ['3', '10', '7']);
        await page.click('#tab-state');
        await page.waitForFunction(() => /digest [0-9a-f]{32}/.test(document.getElementById('state-digest').textContent));
        const frame = await frameOf(page), own = (await page.textContent('#state-digest')).replace('digest ', '');
        assert.ok(frame >= 12);
        const scratch = mkdtempSync(join(tmpdir(), 'petri-')), script = join(scratch, 'a.fl');
        writeFileSync(script, SCRIPT);
        const native = execFileSync(petri, ['run', script, '-D', 'MASS=3', '-D', 'PUSH=10', '-D', 'HEAT=7', '--frames', String(frame + 1),
            '--print', 'digest', '--quiet'], { encoding: 'utf8' });
        rmSync(scratch, { recursive: true });
        assert.ok(native.includes(own), `frame ${frame}: ${own}, ${native}`);
    },
}));

const lives = async page => {
    let first;
    do // the browser shows pictures of workers later
        first = await sums(page);
    while (new Set(first).size < 16); // no two dishes look alike
    const at = Number(await page.getAttribute('#grid td button', 'data-frame'));
    await page.click('#grid-run');
    await reach(page, at + 20);
    const later = await sums(page);
    assert.ok(first.every((sum, i) => sum !== later[i]), 'all dishes move');
};

test('all dishes of the grid move, and the script of the page rests', options, () => opened('', {
    use: async page => {
        await loaded(page, SCRIPT);
        await page.click('#run');
        await gridOf(page, 16);
        await lives(page);
        const frame = await frameOf(page);
        await reach(page, 40);
        assert.equal(await frameOf(page), frame);
        await page.keyboard.press('Escape');
        await page.waitForFunction(at => Number(document.body.dataset.frame) > at, frame);
    },
}));

test('in Firefox, all dishes of the grid move', firefoxOptions, () => openedInFirefox(async page => {
    const { packLink } = await import('../../src/web/page/link.mjs');
    await page.evaluate(link => (location.hash = link), await packLink({ text: SCRIPT, name: 'a.fl' }));
    await page.waitForFunction(() => document.getElementById('picture').width === 200 && document.body.dataset.frame === '2');
    await gridOf(page, 16);
    if (await page.textContent('#grid-run') === 'Pause')
        await page.click('#grid-run');
    await lives(page);
}));

test('dishes that are out of view stop, and catch up when they are seen', options, () => opened('', {
    use: async page => {
        await loaded(page, SCRIPT);
        await page.setViewportSize({ width: 500, height: 400 });
        await page.click('#grid-open');
        await page.selectOption('#grid-across-count', '6');
        await page.selectOption('#grid-down-count', '6');
        await page.waitForFunction(() => document.querySelectorAll('#grid td button').length === 24); // MASS has only four whole values
        await page.click('#grid-run');
        await reach(page, 30);
        const frames = () => page.evaluate(() => [...document.querySelectorAll('#grid td button')].map(({ dataset }) =>
            Number(dataset.frame ?? -1)));
        const seen = await frames(), last = seen.at(-1);
        assert.ok(last < 10 && seen[0] >= 30, `${seen}`);
        await page.locator('#grid td button').last().scrollIntoViewIfNeeded();
        await page.waitForFunction(() => Number(document.querySelector('#grid tr:last-child td:last-child button').dataset.frame) >= 40);
    },
}));

test('the grid is used by keyboard, and axe finds nothing', options, () => opened('', {
    use: async page => {
        await loaded(page, SCRIPT);
        await page.focus('#grid-open');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => document.querySelectorAll('#grid td button[data-frame]').length === 16);
        await page.evaluate(readFileSync(join(root, 'src/web/page/node_modules/axe-core/axe.min.js'), 'utf8'));
        const { violations } = await page.evaluate(() => globalThis.axe.run('#grid'));
        assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes[0].html]), []);
        for (let i = 0; i < 20 && !await page.evaluate(() => document.activeElement.matches('#grid td button')); i++)
            await page.keyboard.press('Tab');
        const label = () => page.evaluate(() => document.activeElement.ariaLabel), labels = [await label()];
        for (const key of ['ArrowLeft', 'ArrowRight', 'ArrowDown', 'ArrowUp', 'ArrowUp', 'ArrowDown']) {
            await page.keyboard.press(key);
            labels.push(await label());
        }
        const wanted = [[1, 1], [1, 1], [2, 1], [2, 4], [2, 1], [2, 1], [2, 4]];
        assert.deepEqual(labels, wanted.map(([mass, push]) => `MASS ${mass}, PUSH ${push}`));
        await page.keyboard.press('Enter');
        await says(page, /^MASS 2, PUSH 4: the state of frame 2 is that/);
        assert.equal(await page.inputValue('#parameter-PUSH'), '4');
    },
}));

test('the grid says what is missing: parameters, a value that has no effect, a second parameter', options, () => opened('', {
    use: async page => {
        const picture = '!window size=200;100\n    !canvas\n        !rect size=(20*N);50 fill=true\n';
        await loaded(page, `let N=7\n${picture}`);
        await page.click('#grid-open');
        await page.waitForFunction(() => /no parameters with a range/.test(document.getElementById('grid-status')?.textContent));
        await page.keyboard.press('Escape');
        await loaded(page, `let N=N or 1 -- 0..3\n${picture}`);
        await page.waitForSelector('#parameter-N');
        await page.click('#grid-open');
        await page.waitForFunction(() => document.querySelectorAll('#grid td button[data-frame]').length === 4);
        const problems = await page.locator('#grid td span').allTextContents();
        assert.match(problems[0], /^N=0 has no effect/);
        assert.deepEqual(problems.slice(1), ['', '', '']);
        await page.click('[aria-label="N 0"]');
        assert.match(await page.textContent('#grid-status'), /^N 0: N=0 has no effect/);
        await page.keyboard.press('Escape');
        await loaded(page, `let N=N or 1 -- 1..3\n    M=M or 1 -- 1..2\n${picture}`);
        await page.waitForSelector('#parameter-M');
        await page.click('#grid-open');
        await page.selectOption('#grid-down', 'N');
        assert.match(await page.textContent('#grid-status'), /Choose two parameters/);
    },
}));

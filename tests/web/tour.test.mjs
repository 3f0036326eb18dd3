// tour.test.mjs: tests the tour: its lessons and their tasks, the pages, and numbers that are dragged.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { loadEngine } from '../../src/web/engine/petri.mjs';
import { moved } from '../../src/web/page/number.mjs';
import { passes } from '../../src/web/page/task.mjs';
import { LESSONS } from '../../src/web/tour/lessons.mjs';
import { folder, opened, options, pixels, root, typed, visited, world } from './browser.mjs';

const missing = existsSync(join(folder, 'tour/tour.js')) ? false : 'missing: the tour';
const ways = { ...options, skip: options.skip || missing, timeout: 180000 };
const AXE = join(root, 'src/web/page/node_modules/axe-core/axe.min.js');

const fileOf = number => number === 0 ? 'index.html' : `${LESSONS[number].name}.html`;
const visit = (number, use, settings = {}) => visited(`${world.server.url}tour/${fileOf(number)}`, {
    settings: { reducedMotion: 'no-preference', ...settings }, ready: () => document.body.dataset.task, use,
});
const task = (page, state) => page.waitForFunction(wanted => document.body.dataset.task === wanted, state);
const frameOf = page => page.evaluate(() => Number(document.body.dataset.frame));
const textOf = page => page.evaluate(() => [...document.querySelectorAll('.cm-line')].map(line => line.textContent).join('\n'));

test('there are 14 lessons, which their solutions solve and their starts do not', async () => {
    const engine = await loadEngine(readFileSync(join(folder, 'petri/engine.wasm'))), reported = [];
    assert.equal(LESSONS.length, 14);
    assert.equal(new Set(LESSONS.map(({ name }) => name)).size, 14);
    const way = { onDiagnostic: ({ rendered }) => reported.push(rendered) };
    for (const lesson of LESSONS) {
        assert.equal(passes(engine, { ...lesson, text: lesson.start, name: 'start.fl' }, way), false, `${lesson.name}: start`);
        assert.equal(passes(engine, { ...lesson, text: lesson.solution, name: 'end.fl' }, way), true, `${lesson.name}: solution`);
        assert.ok(lesson.start.split('\n').length <= 26, `${lesson.name} fits on a screen`);
        assert.ok(lesson.prose.split(/\s+/).length < 130, `${lesson.name} has a short text`);
    }
    assert.deepEqual(reported.filter(text => !/unbound name|null/.test(text)), []);
    assert.equal(passes(engine, { ...LESSONS[0], text: 'let x=(1;', name: 'bad.fl' }), false);
});

test('a task is solved by an edit, which the tour remembers', ways, () => visit(0, async page => {
    await task(page, 'open');
    const at = await frameOf(page);
    await page.waitForFunction(frame => Number(document.body.dataset.frame) > frame + 3, at);
    await typed(page, LESSONS[0].start.replace('40;20', '130;20'));
    await task(page, 'solved');
    assert.equal(await page.textContent('#result'), '✓ Solved');
    assert.ok(await frameOf(page) > at, 'the run continues');
    await page.reload();
    await task(page, 'solved');
    assert.match(await textOf(page), /130;20/);
    assert.equal(await page.locator('#lessons .solved').count(), 1);
    await page.click('#again');
    await task(page, 'open');
    assert.match(await textOf(page), /40;20/);
    await page.click('#solve');
    await task(page, 'solved');
    await typed(page, '!physics state=(');
    await page.waitForSelector('#problems .error');
    await task(page, 'open');
}));

test('numbers are dragged with Alt, and picture and task follow', ways, () => visit(0, async page => {
    const number = page.locator('.cm-line').nth(1).locator('span', { hasText: /^40$/ });
    const { x, y, width, height } = await number.boundingBox(), { sum } = await pixels(page);
    await page.keyboard.down('Alt');
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 200, y + height / 2, { steps: 5 });
    await page.waitForFunction(() => document.querySelector('.cm-content').textContent.includes('velocity=90;20'));
    await page.mouse.move(x + width / 2 + 400, y + height / 2, { steps: 5 });
    await page.mouse.up();
    await page.keyboard.up('Alt');
    assert.match(await textOf(page), /velocity=140;20/);
    await task(page, 'solved');
    assert.notEqual((await pixels(page)).sum, sum);
    await page.mouse.move(x, y);
    assert.match(await textOf(page), /velocity=140;20/, 'the drag has ended');
    await page.click('.cm-content');
    await page.keyboard.press('Control+z');
    assert.doesNotMatch(await textOf(page), /velocity=140;20/);
}));

test('a dragged number keeps its digits', () => {
    assert.equal(moved('40', 3), '43');
    assert.equal(moved('0.05', -7), '-0.02');
    assert.equal(moved('1.50', 1), '1.51');
    assert.equal(moved('1', -1), '0');
    assert.equal(moved('0.1', -1), '0.0');
});

test('each lesson has a page with a running dish, and the next is one click away', ways, () => visit(0, async page => {
    for (let i = 0; i < LESSONS.length; i++) {
        await page.waitForFunction(() => document.body.dataset.task === 'open' && Number(document.body.dataset.frame) > 3);
        assert.equal(await page.textContent('h1'), LESSONS[i].title);
        assert.equal(await page.textContent('#message'), '');
        assert.equal(await page.textContent('#problems'), '', LESSONS[i].name);
        assert.ok((await pixels(page)).all > 5, LESSONS[i].name);
        if (i + 1 < LESSONS.length) {
            await page.click('#next');
            await page.waitForURL(`**/tour/${fileOf(i + 1)}`);
        }
    }
    await page.click('#back');
    await page.waitForURL(`**/tour/${fileOf(LESSONS.length - 2)}`);
}));

test('the first page leads to the tour, which works offline', ways, () => opened('', {
    settings: { reducedMotion: 'no-preference' },
    use: async (page, context) => {
        await page.click('a:text-is("Tour")');
        await page.waitForFunction(async () => document.body.dataset.task && await caches.match('tour.js'));
        await page.waitForLoadState('networkidle'); // requests that are under way would fail
        await context.setOffline(true);
        await page.goto(`${world.server.url}tour/${fileOf(LESSONS.length - 1)}`);
        await task(page, 'open');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 5);
    },
}));

test('the last lesson makes a film', ways, async () => {
    const short = route => route.fetch().then(async response =>
        route.fulfill({ response, body: (await response.text()).replace('"film":180', '"film":6') }));
    await visited(`${world.server.url}tour/film.html`, {
        prepare: page => page.route('**/film.html', short), ready: () => document.body.dataset.task,
        use: async page => {
            const [file] = await Promise.all([page.waitForEvent('download'), page.click('#film')]);
            assert.equal(file.suggestedFilename(), 'petri.webm');
            assert.ok(readFileSync(await file.path()).length > 1000);
        },
    });
});

test('the tour is accessible, in light and dark, and fits on a phone', ways, async () => {
    for (const [number, colorScheme, viewport] of [[0, 'light', { width: 1280, height: 800 }], [13, 'dark', { width: 390, height: 844 }]])
        await visit(number, async page => {
            await page.evaluate(readFileSync(AXE, 'utf8'));
            const { violations } = await page.evaluate(() => globalThis.axe.run());
            assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes[0].html]), []);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
            // The picture is as large as its place, and stays in view while the last line is edited.
            const [frame, picture] = [await page.locator('#frame').boundingBox(), await page.locator('#picture').boundingBox()];
            const free = Math.min(frame.width - picture.width, frame.height - picture.height);
            assert.ok(Math.abs(free) < 2, `${free} pixels are free`);
            await page.click('.cm-line >> nth=-1');
            await page.keyboard.press('End');
            const { y, height } = await page.locator('#picture').boundingBox();
            assert.ok(y >= 0 && y + height <= viewport.height, `the picture is at ${y}`);
        }, { colorScheme, viewport, reducedMotion: 'reduce' });
});

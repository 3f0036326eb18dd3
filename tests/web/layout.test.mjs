// layout.test.mjs: the picture comes first and keeps its size, and the lines of the script wrap, in three windows and two browsers.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { firefoxOptions, opened, openedInFirefox, options, typed } from './browser.mjs';

const SIZES = [[390, 844], [1280, 800], [1920, 1080]];
const SCRIPT = 'let A=A or 1 -- 1..2\n!window size=400;400\n    !canvas\n        !rect size=400;400 fill=true\n';

const box = (page, selector) => page.locator(selector).boundingBox();

// On a phone, the page scrolls, and the picture is smaller while the editor has the focus.
const rest = page => page.evaluate(() => {
    document.activeElement.blur();
    scrollTo(0, 0);
});

// Checks the page at one size of the window.
async function fits(page, [width, height]) {
    await page.setViewportSize({ width, height });
    await typed(page, SCRIPT);
    await page.waitForFunction(() => document.getElementById('picture').width === 400);
    await rest(page);
    if (process.env.SHOTS)
        await page.screenshot({ path: `${process.env.SHOTS}/layout-${width}.png` });
    const at = `${width} × ${height}`, picture = await box(page, '#picture'), editor = await box(page, '#editor');
    assert.ok(picture.width > (width < 800 ? 0.9 * width : 0.45 * width), `${at}: the picture is ${picture.width} wide`);
    assert.ok(picture.x < editor.x || picture.y + picture.height <= editor.y, `${at}: the picture comes first`);
    for (const selector of ['#picture', '#run', '#editor', '#line']) {
        const { x, width: wide } = await box(page, selector);
        assert.ok(x >= 0 && wide > 20 && x + wide <= width, `${at}: ${selector}`);
    }

    // Neither output, panels, messages of many lines nor problems change the picture.
    const look = async what => {
        await rest(page);
        assert.deepEqual(await box(page, '#picture'), picture, `${at}: ${what}`);
    };
    await page.fill('#line', '.help');
    await page.press('#line', 'Enter');
    await page.waitForFunction(() => document.getElementById('printed').textContent.length > 500);
    await look('output of the prompt');
    for (const tab of ['plot', 'state', 'particle', 'prompt']) {
        await page.click(`#tab-${tab}`);
        await look(tab);
    }
    await page.evaluate(() => (document.getElementById('message').textContent = 'many words '.repeat(60)));
    await look('a long message');
    await typed(page, `${SCRIPT}!a b=(\n`);
    await page.waitForFunction(() => document.getElementById('problems').textContent);
    const problems = await box(page, '#problems');
    assert.ok(problems.height > 10 && problems.y + problems.height <= height, `${at}: problems are in view while the script is edited`);
    await look('problems');

    // A long line wraps, to the right of its first character.
    await typed(page, `${SCRIPT}        -- ${'many words '.repeat(40)}\n`);
    const wrapped = await page.evaluate(() => {
        const line = [...document.querySelectorAll('.cm-line')].find(({ textContent }) => textContent.includes('many words'));
        const range = document.createRange();
        range.selectNodeContents(line);
        const rows = [...range.getClientRects()], below = rows.filter(({ y }) => y > rows[0].y + 10).map(({ x }) => Math.round(x));
        const { scrollWidth, clientWidth } = document.querySelector('.cm-scroller');
        return { first: line.textContent.search(/\S/), below, over: scrollWidth - clientWidth };
    });
    const { x: left } = await box(page, '.cm-content'), { first, below, over } = wrapped;
    assert.ok(first >= 8 && below.length > 3 && over <= 0, `${at}: ${JSON.stringify(wrapped)}`);
    assert.ok(below.every(x => x === below[0]) && below[0] > left + 8 * first, `${at}: ${JSON.stringify(wrapped)}`);
}

test('in Chromium, the picture is first and keeps its size, and lines wrap', options, () => opened('', {
    use: async page => {
        for (const size of SIZES)
            await fits(page, size);
    },
}));

test('in Firefox, the picture is first and keeps its size, and lines wrap', firefoxOptions, () => openedInFirefox(async page => {
    for (const size of SIZES)
        await fits(page, size);
}));

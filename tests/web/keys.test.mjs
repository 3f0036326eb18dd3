// keys.test.mjs: touch, keys, full screen, the splitter and the theme.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { atFrame, frameOf, opened, options, root, typed, world } from './browser.mjs';

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const POINTER = '!window size=200;200\n    !pointer state=:at\n    !canvas\n        !rect size=200;200 fill=true\n';

const box = (page, selector) => page.locator(selector).boundingBox();
const setting = page => page.evaluate(() => document.documentElement.dataset.theme);

async function load(page, text) {
    await typed(page, text);
    await page.waitForFunction(() => document.getElementById('picture').width === 200);
    await page.evaluate(() => scrollTo(0, 0));
}

// Drags a finger on the picture from its middle by `by` pixels upwards, and returns how far the page has scrolled.
async function drag(page, by) {
    const { x, y, width, height } = await box(page, '#picture'), client = await page.context().newCDPSession(page);
    const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
    const at = moved => [{ x: x + width / 2, y: y + height / 2 - moved }];
    await touch('touchStart', at(0));
    for (let moved = 10; moved <= by; moved += 10)
        await touch('touchMove', at(moved));
    await touch('touchEnd', []);
    await page.waitForTimeout(100);
    return page.evaluate(() => scrollY);
}

test('on a phone, a finger on the picture is the pointer of a script that asks for it, and otherwise scrolls', options, () => opened('', {
    settings: PHONE,
    use: async page => {
        await load(page, POINTER);
        await page.evaluate(() => {
            globalThis.events = [];
            for (const type of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel'])
                document.getElementById('picture').addEventListener(type, event => globalThis.events.push(event.type));
        });
        assert.equal(await drag(page, 100), 0);
        const events = await page.evaluate(() => globalThis.events);
        assert.ok(events.filter(type => type === 'pointermove').length > 5 && !events.includes('pointercancel'), `${events}`);
        await load(page, POINTER.replace('    !pointer state=:at\n', ''));
        assert.ok(await drag(page, 100) > 20);
    },
}));

test('a drag that leaves the picture is still reported', options, () => opened('', {
    use: async page => {
        await load(page, POINTER);
        const { x, y, width, height } = await box(page, '#picture');
        await page.mouse.move(x + width / 2, y + height / 2);
        await page.mouse.down();
        await page.mouse.move(x + width / 2, y + height + 150);
        await page.evaluate(() => document.getElementById('step').click());
        await page.evaluate(() => {
            document.getElementById('line').value = 'round(100*$(:at))';
            document.getElementById('line').form.requestSubmit();
        });
        await page.waitForFunction(() => /\n50;100\n$/.test(document.getElementById('printed').textContent));
        await page.mouse.up();
    },
}));

test('on a phone, picture and Run stay in view while the text is edited', options, () => opened('', {
    settings: PHONE,
    use: async page => {
        await page.tap('.cm-content');
        await page.keyboard.press('Control+End');
        await page.keyboard.insertText('\n-- mine');
        for (const top of [0, 100000]) {
            await page.evaluate(y => scrollTo(0, y), top);
            const [picture, run] = [await box(page, '#picture'), await box(page, '#run')];
            assert.ok(picture.y >= 0 && picture.height > 100 && run.y > picture.y + picture.height && run.y + run.height < 600,
                JSON.stringify([top, picture, run]));
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
        }
        const place = await page.evaluate(() => {
            const run = document.getElementById('run').getBoundingClientRect();
            return document.elementFromPoint(run.x + run.width / 2, run.y + run.height / 2).id;
        });
        assert.equal(place, 'run');
    },
}));

test('keys run, step, save and show the list of keys', options, () => opened('', {
    use: async page => {
        const downloaded = async key => {
            const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press(key)]);
            return download.suggestedFilename();
        };
        await page.focus('#picture');
        await page.keyboard.press('.');
        await atFrame(page, 3);
        await page.keyboard.press(',');
        await atFrame(page, 2);
        await page.keyboard.press('Space');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 9);
        await page.keyboard.press('Space');
        await page.waitForFunction(() => document.getElementById('run').textContent === 'Run');
        // Frames that were already being computed may still arrive.
        const before = await frameOf(page), saved = Number(/^dish-(\d+)\.png$/.exec(await downloaded('s'))?.[1]);
        assert.ok(before <= saved && saved <= await frameOf(page), `picture ${saved}, shown first ${before}`);
        await page.keyboard.press('r');
        await atFrame(page, 0);
        await page.keyboard.press('f');
        await page.waitForFunction(() => document.fullscreenElement?.id === 'frame');
        const { width, height } = await box(page, '#picture'), view = page.viewportSize();
        assert.ok(Math.abs(width - height) < 2 && height > 0.9 * view.height, `${width} by ${height}`);
        await page.keyboard.press('f');
        await page.waitForFunction(() => !document.fullscreenElement);
        await page.keyboard.press('?');
        assert.ok(await page.isVisible('#keys'));
        await page.keyboard.press('Escape');
        await page.focus('.cm-content');
        assert.equal(await downloaded('Control+s'), 'dish.fl');
        await page.keyboard.type('?s.');
        assert.ok(await page.isHidden('#keys'));
        // A script that asks for keys gets them.
        await load(page, POINTER.replace('!pointer state=:at', '!key name=:period state=:k'));
        const frame = await frameOf(page);
        await page.focus('#picture');
        await page.keyboard.press('.');
        await page.focus('#run');
        await page.keyboard.press('.');
        await atFrame(page, frame + 1);
    },
}));

test('Escape and Tab leave the editor, and the page says so', options, () => opened('', {
    use: async page => {
        await page.click('.cm-content');
        await page.keyboard.press('Tab');
        assert.ok(await page.evaluate(() => document.activeElement.classList.contains('cm-content')));
        await page.keyboard.press('Escape');
        await page.keyboard.press('Tab');
        assert.ok(await page.evaluate(() => document.activeElement.matches('#side :not(#editor *)')));
        assert.match(await page.textContent('#advice'), /Esc, then Tab leaves the editor/);
        assert.equal(await page.getAttribute('.cm-content', 'aria-describedby'), 'advice');
    },
}));

test('the splitter is moved by keys and pointer, and stays', options, () => opened('', {
    use: async page => {
        const share = () => page.evaluate(() => document.getElementById('dish').offsetWidth / innerWidth);
        await page.focus('#splitter');
        for (let i = 0; i < 5; i++)
            await page.keyboard.press('ArrowRight');
        assert.ok(Math.abs(await share() - 0.65) < 0.02, `${await share()}`);
        const { x, y } = await box(page, '#splitter');
        await page.mouse.move(x + 3, y + 300);
        await page.mouse.down();
        await page.mouse.move(360, y + 320);
        await page.mouse.up();
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.ok(Math.abs(await share() - 0.3) < 0.02, `${await share()}`);
        assert.equal(await page.getAttribute('#splitter', 'aria-valuenow'), '30');
    },
}));

test('dark or light is one setting of page and manual', options, () => opened('', {
    use: async page => {
        await page.click('#theme');
        assert.equal(await setting(page), 'dark');
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await setting(page), 'dark');
        await page.goto(`${world.server.url}manual/index.html`);
        assert.equal(await setting(page), 'dark');
        await page.click('#theme');
        await page.goto(world.server.url);
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await setting(page), 'light');
    },
}));

test('axe finds nothing in the list of keys and on a phone', options, () => opened('', {
    settings: PHONE,
    use: async page => {
        const violations = async () => (await page.evaluate(() => globalThis.axe.run())).violations
            .map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 100))]);
        await page.evaluate(readFileSync(join(root, 'src/web/page/node_modules/axe-core/axe.min.js'), 'utf8'));
        assert.deepEqual(await violations(), []);
        await page.tap('#help');
        assert.deepEqual(await violations(), []);
    },
}));

test('the search in the script says how many matches there are, also after an edit, and when there are none', options, () => opened('', {
    use: async page => {
        await typed(page, 'let a=1\nlet b=a+a\n');
        await page.keyboard.press('Control+f');
        const search = async (text, found) => {
            await page.fill('.cm-search [name=search]', text);
            await page.press('.cm-search [name=search]', 'End'); // the editor reads the field after a key
            await page.waitForFunction(wanted => document.querySelector('.cm-search output')?.textContent === wanted, found);
        };
        await search('zebra', 'no matches');
        await search('let b', '1 match');
        await search('a', '3 matches');
        await page.fill('.cm-search [name=replace]', 'long');
        await page.press('.cm-search [name=replace]', 'End');
        await page.click('.cm-search [name=replaceAll]');
        await page.waitForFunction(() => document.querySelector('.cm-search output').textContent === 'no matches');
        await page.check('.cm-search [name=re]');
        await search('(', 'not a regular expression');
        await search('l.n', '3 matches');
        await search('', '');
    },
}));

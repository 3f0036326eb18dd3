// scripts.test.mjs: the first visit, the gallery, and the user's scripts in the browser's storage.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, frameOf, opened, options, typed, visibleWithin } from './browser.mjs';

const MOVES = { reducedMotion: 'no-preference' };
const SQUARE = '!window size=64;32\n    !canvas\n        !rect size=64;32 color=1;0.5;0 fill=true\n';

// Returns the first lines of the script, because the editor contains only the visible ones.
const lines = page => page.evaluate(() => [...document.querySelectorAll('.cm-line')].slice(0, 9).map(line => line.textContent).join('\n'));
const names = page => page.locator('#own-scripts .name').allTextContents();
const stored = page => page.evaluate(() => Object.keys(localStorage).filter(key => key.startsWith('petri.script.')).length);
const passes = (page, frame) => page.waitForFunction(min => Number(document.body.dataset.frame) > min, frame);

async function addTo(page, text) {
    await page.click('.cm-content');
    await page.keyboard.press('Control+Home');
    await page.keyboard.insertText(text);
}

test('the first visit shows a running dish and says what to change', options, () => opened('', {
    settings: MOVES,
    use: async page => {
        await passes(page, 5);
        assert.equal(await page.inputValue('#name'), 'dish.fl');
        assert.match(await page.textContent('#hint'), /Change a number in the script/);
        assert.ok(!/petri (view|run)/.test(await page.textContent('.cm-content')));
        assert.equal(await stored(page), 0);
        await page.click('#hint-close');
        await page.reload();
        await passes(page, 5);
        assert.ok(await page.isHidden('#hint'));
    },
}));

test('the first picture moves within 1.5 seconds, with nothing cached', options, () => visibleWithin(1500, '', frame => frame > 2, MOVES));

test('the gallery draws samples, moves the one under the pointer, and opens it', options, () => opened('', {
    settings: MOVES,
    use: async page => {
        const sum = name => page.evaluate(called => {
            const card = [...document.querySelectorAll('#sample-cards button')]
                .find(button => button.querySelector('strong').textContent === called);
            const { data } = card.querySelector('canvas').getContext('2d').getImageData(0, 0, 320, 240);
            return data.reduce((all, byte) => (all * 31 + byte) % 4294967291, 0);
        }, name);
        await page.click('#scripts');
        const empty = await sum('trails'), card = page.locator('#sample-cards button:has(strong:text-is("beads"))');
        await page.waitForFunction(() => [...document.querySelectorAll('#sample-cards canvas')].filter(canvas =>
            canvas.getContext('2d').getImageData(0, 0, 320, 240).data.some(byte => byte > 0)).length >= 4);
        await card.hover();
        const seen = new Set();
        for (let i = 0; i < 300 && seen.size < 4; i++) {
            seen.add(await sum('beads'));
            await page.waitForTimeout(50);
        }
        assert.ok(seen.size >= 4, `${seen.size} pictures; nothing is ${empty}`);
        await card.click();
        await page.waitForFunction(() => document.getElementById('name').value === 'beads.fl');
        await passes(page, 5);
        assert.match(await lines(page), /^-- .*\n/);
        assert.equal(await page.evaluate(() => document.querySelector('.cm-scroller').scrollTop), 0);
        assert.equal(await stored(page), 0);
    },
}));

test('the gallery shows the pictures of the manual, and computes one that cannot be loaded', options, () => opened('', {
    settings: { serviceWorkers: 'block' }, // its requests would not be seen
    expected: /Failed to load resource|willReadFrequently|Service Worker registration blocked/,
    use: async page => {
        const loaded = new Set();
        await page.route('**/manual/pictures/*', route => {
            const name = route.request().url().replace(/.*pictures-|[.]png$/g, '');
            loaded.add(name);
            return name === 'hello' ? route.abort() : route.continue();
        });
        const names = ['hello', 'bubble', 'trails'];
        await page.click('#scripts');
        await page.waitForFunction(wanted => [...document.querySelectorAll('#sample-cards button')].filter(button =>
            wanted.includes(button.querySelector('strong').textContent)).every(button =>
            button.querySelector('canvas').getContext('2d').getImageData(0, 0, 320, 240).data.some(byte => byte > 0)), names);
        assert.deepEqual(names.filter(name => !loaded.has(name)), []);
    },
}));

test('scripts are made, renamed, duplicated, deleted and restored', options, () => opened('', {
    use: async page => {
        await page.click('#new');
        await page.waitForFunction(() => document.getElementById('name').value === 'script.fl');
        await page.fill('#name', 'round/ trip');
        await page.press('#name', 'Enter');
        assert.equal(await page.inputValue('#name'), 'round trip.fl');
        await page.click('#scripts');
        assert.deepEqual(await names(page), ['round trip.fl']);
        await page.click('[aria-label="Duplicate round trip.fl"]');
        await page.waitForFunction(() => document.getElementById('name').value === 'round trip-2.fl');
        await addTo(page, '-- two\n');
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        assert.equal(await page.inputValue('#name'), 'round trip-2.fl');
        assert.match(await lines(page), /^-- two\n/);
        await page.click('#scripts');
        assert.deepEqual(await names(page), ['round trip-2.fl', 'round trip.fl']);
        await page.click('[aria-label="Delete round trip.fl"]');
        assert.deepEqual([await names(page), await stored(page)], [['round trip-2.fl'], 1]);
        await page.keyboard.press('Enter'); // Undo has the focus
        assert.deepEqual([await names(page), await stored(page)], [['round trip-2.fl', 'round trip.fl'], 2]);
        await page.click('#own-scripts .name >> text="round trip.fl"');
        await page.waitForFunction(() => document.getElementById('name').value === 'round trip.fl');
        assert.match(await lines(page), /^-- A disc/);
    },
}));

test('each script has its own history for undo', options, () => opened('', {
    use: async page => {
        const dish = await lines(page), undone = async () => {
            await page.click('.cm-content');
            await page.keyboard.press('Control+z');
        };
        await addTo(page, '-- mine\n');
        await choose(page, 'hello');
        await page.waitForFunction(() => document.getElementById('name').value === 'hello.fl');
        const hello = await lines(page);
        await undone();
        assert.equal(await lines(page), hello);
        assert.equal(await stored(page), 1);
        await page.click('#scripts');
        await page.click('#own-scripts .name');
        await page.waitForFunction(() => document.querySelector('.cm-line').textContent === '-- mine');
        await undone();
        assert.equal(await lines(page), dish);
        assert.equal(await page.evaluate(() => document.body.dataset.frame), '2');
    },
}));

const full = page => page.evaluate(() => {
    for (let size = 1 << 22; size >= 64; size /= 2)
        try {
            localStorage.setItem(`rest${size}`, 'x'.repeat(size - 16));
        } catch {
            // the browser's storage is full
        }
});
const blocked = page => page.evaluate(() => Object.defineProperty(globalThis, 'localStorage', {
    get() { throw new DOMException('denied', 'SecurityError'); },
}));

for (const [what, make, said] of [['full', full, /^dish\.fl is not stored: the browser's storage is full/],
    ['blocked', blocked, /^dish\.fl is not stored: the browser blocks its storage/]])
    test(`storage that is ${what} is reported, and the script runs`, options, () => opened('', {
        use: async page => {
            await make(page);
            await typed(page, `-- ${'.'.repeat(3000)}\n${SQUARE}`);
            await page.waitForFunction(() => document.getElementById('storage').textContent);
            assert.match(await page.textContent('#storage'), said);
            await page.waitForFunction(() => document.getElementById('picture').width === 64);
            assert.ok(await frameOf(page) >= 0);
            await page.click('#scripts');
            assert.ok(await page.isVisible('#sample-cards'));
            await page.keyboard.press('Escape');
            if (what === 'full') {
                await page.evaluate(() => localStorage.removeItem('rest4194304'));
                await addTo(page, '-- again\n');
                await page.waitForFunction(() => !document.getElementById('storage').textContent);
            }
        },
    }));

// Types a comment in front of the script, and waits until it is stored.
async function note(page, text) {
    await addTo(page, `-- ${text}\n`);
    await page.waitForFunction(wanted => Object.values(localStorage).some(item => item.includes(wanted)), `-- ${text}`);
}

const stores = page => page.evaluate(() => Object.entries(localStorage).filter(([key]) => key.startsWith('petri.script.'))
    .map(([, item]) => JSON.parse(item)).map(({ name, text }) => [name, text.split('\n!')[0].replace(/\nlet [^]*/, '').trim()]).sort());
const remark = page => page.textContent('#elsewhere');

// Opens another tab that shows the script that was edited last.
async function nextTab(page, context) {
    const other = await context.newPage();
    await other.goto(page.url());
    await other.waitForFunction(() => document.body.dataset.ready);
    return other;
}

test('two tabs with one script keep the edits of both', options, () => opened('', {
    use: async (page, context) => {
        await typed(page, SQUARE);
        const other = await nextTab(page, context);
        assert.equal(await lines(other), await lines(page));
        await note(other, 'second');
        await page.waitForFunction(() => /changed in another tab/.test(document.getElementById('elsewhere').textContent));
        assert.equal(await remark(page),
            'dish.fl was changed in another tab. If you edit it here, it becomes dish-2.fl. Open that version');
        assert.equal(await remark(other), '');
        await note(page, 'first');
        await note(other, 'third');
        assert.deepEqual((await stores(page)).map(([name, text]) => [name, text.match(/^-- .*/gm)]),
            [['dish-2.fl', ['-- first']], ['dish.fl', ['-- third', '-- second']]]);
        assert.equal(await page.inputValue('#name'), 'dish-2.fl');
        assert.equal(await other.inputValue('#name'), 'dish.fl');
        assert.equal(await remark(other), '');
        await page.click('#elsewhere button');
        await page.waitForFunction(() => document.getElementById('name').value === 'dish.fl');
        assert.equal(await remark(page), '');
        assert.equal(await lines(page), await lines(other));
        await note(page, 'fourth'); // now this tab changes the script of the other
        await other.waitForFunction(() => /changed in another tab/.test(document.getElementById('elsewhere').textContent));
        assert.match(await remark(other), /becomes dish-3\.fl/);
    },
}));

test('a change without an event is not overwritten', options, () => opened('', {
    use: async page => {
        await typed(page, SQUARE);
        // The page gets no event for a change by itself, as a frozen tab gets none.
        await page.evaluate(() => Object.keys(localStorage).filter(key => key.startsWith('petri.script.')).forEach(key =>
            localStorage.setItem(key, JSON.stringify({ ...JSON.parse(localStorage.getItem(key)), text: '-- theirs\n' }))));
        await addTo(page, '-- mine\n');
        await page.waitForFunction(() => document.getElementById('elsewhere').textContent);
        const texts = (await stores(page)).map(([name, text]) => [name, text.split('\n')[0]]);
        assert.deepEqual(texts, [['dish-2.fl', '-- mine'], ['dish.fl', '-- theirs']]);
    },
}));

test('a new name or a deletion in another tab is followed', options, () => opened('', {
    use: async (page, context) => {
        await typed(page, SQUARE);
        const other = await nextTab(page, context);
        await other.fill('#name', 'square');
        await other.press('#name', 'Enter');
        await page.waitForFunction(() => document.getElementById('name').value === 'square.fl');
        assert.equal(await remark(page), '');
        await note(page, 'more');
        await other.waitForFunction(() => document.getElementById('elsewhere').textContent);
        await page.click('#scripts');
        await page.click('[aria-label="Delete square.fl"]');
        await note(other, 'alive');
        assert.equal(await stored(other), 1);
    },
}));

test('the hint about a number of the first script is shown with that script only', options, () => opened('', {
    use: async page => {
        const hint = () => page.isVisible('#hint');
        assert.ok(await hint());
        await choose(page, 'hello');
        await page.waitForFunction(() => document.getElementById('name').value === 'hello.fl');
        assert.ok(!await hint());
        await choose(page, 'dish');
        await page.waitForFunction(() => document.getElementById('name').value === 'dish.fl');
        assert.ok(await hint());
        await page.click('#hint-close');
        await choose(page, 'hello');
        await choose(page, 'dish');
        await page.waitForFunction(() => document.getElementById('name').value === 'dish.fl');
        assert.ok(!await hint());
    },
}));

// script.test.mjs: tests the script editor of the page: colours, parameters, the automatic picture, copied links, saved scripts.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { readLink } from '../../src/web/page/link.mjs';
import { atFrame, frameOf, opened, options, pixels, seek, typed } from './browser.mjs';

async function shown(page, text) {
    await page.evaluate(() => delete document.body.dataset.frame);
    await typed(page, text);
    await page.click('#reset');
    await atFrame(page, 0);
}

async function steps(page, end) {
    for (let frame = await frameOf(page); frame++ < end;) {
        await page.click('#step');
        await atFrame(page, frame);
    }
}

test('tokens are coloured by their kind', options, () => opened('', {
    use: async page => {
        await typed(page, '-- said\nlet n=12\n!canvas a=n b="word" c=:symbol\n');
        const colours = await page.waitForFunction(() => {
            // Spans of diagnostics contain those of tokens.
            const spans = [...document.querySelectorAll('.cm-line span:not(:has(span))')];
            const of = text => spans.filter(span => span.textContent.trim() === text).map(span => getComputedStyle(span).color)[0];
            const found = ['-- said', 'let', '12', '!canvas', '"word"', ':symbol'].map(of);
            return found.every(Boolean) && { found, plain: getComputedStyle(document.querySelector('.cm-content')).color };
        });
        const { found, plain } = await colours.jsonValue();
        assert.ok(!found.includes(plain), `${found}`);
        assert.ok(new Set(found.slice(0, 4)).size === 4, `${found}`);
    },
}));

test('a parameter has the range of its comment, and a change affects only later frames', options, () => opened('', {
    use: async page => {
        const script = 'let A=A or 20 -- 10..40|5 how wide\n    B=B or 3\n    C=C or "red"\n    D=5\n'
            + '!window size=64;8\n    !canvas\n        !rect size=A;8 color=((1;0;0) if C=="red" else (0;0;1)) fill=true\n';
        await shown(page, script);
        const slider = page.locator('#parameters input[type=range]');
        assert.equal(await slider.count(), 1); // parameters without a range are fields; other names are not shown
        assert.deepEqual(await slider.evaluate(({ min, max, step, value, title }) => [min, max, step, value, title]),
            ['10', '40', '5', '20', 'how wide']);
        assert.deepEqual(await page.locator('#parameters input:not([type=range])').evaluateAll(all =>
            all.map(({ id, type, value }) => [id, type, value])),
        [['parameter-A', 'number', '20'], ['parameter-B', 'number', '3'], ['parameter-C', 'text', "'red'"]]);
        const at = x => page.locator('#picture').evaluate((canvas, place) =>
            [...canvas.getContext('2d').getImageData(place, 4, 1, 1).data], x);
        await steps(page, 5);
        await seek(page, 3);
        await slider.focus();
        await page.keyboard.press('ArrowRight');
        assert.equal(await page.inputValue('#parameter-A'), '25');
        await page.fill('#parameter-C', "'blue'");
        await page.press('#parameter-C', 'Enter');
        await page.waitForFunction(() => document.getElementById('time').max === '3'); // later frames were discarded
        await page.click('#step');
        await atFrame(page, 4);
        assert.deepEqual([await at(23), await at(27)], [[0, 0, 255, 255], [0, 0, 0, 255]]);
        await seek(page, 2);
        assert.deepEqual([await at(18), await at(23)], [[255, 0, 0, 255], [0, 0, 0, 255]]);
        await seek(page, 4);
        assert.deepEqual(await at(23), [0, 0, 255, 255]);
    },
}));

test('a script without a picture shows its particles', options, () => opened('', {
    use: async page => {
        const system = '!physics state=:world dimensions=2\n    !particle id=0 radius=9 position=0;0 velocity=90;0\n'
            + '    !particle id=1 radius=9 position=60;40\n';
        await shown(page, system);
        await steps(page, 2);
        const first = await pixels(page);
        assert.ok(first.all > 3, JSON.stringify(first));
        await steps(page, 9);
        assert.notEqual((await pixels(page)).sum, first.sum);
        await seek(page, 2);
        assert.equal((await pixels(page)).sum, first.sum);
    },
}));

test('a copied link has script, changes, frame and digest, and needs no network', options, () => {
    const asked = [];
    return opened('', {
        settings: { permissions: ['clipboard-read', 'clipboard-write'] },
        use: async page => {
            await shown(page, 'let A=A or 1 -- 0..9\n!counter state=:c rate=A\n!window size=8;8\n    !canvas\n');
            await page.fill('#parameter-A', '7');
            await page.press('#parameter-A', 'Enter');
            await page.click('#step');
            await atFrame(page, 1);
            page.on('request', request => asked.push(request.url()));
            await page.click('#link');
            await page.waitForFunction(() => /^Link copied/.test(document.getElementById('message').textContent));
            const copied = await page.evaluate(() => navigator.clipboard.readText());
            assert.equal(copied, page.url());
            const { text, frame, digest, changes } = await readLink(new URL(copied).hash);
            assert.match(text, /^let A=A or 1/);
            assert.equal(frame, 1);
            assert.match(digest, /^[0-9a-f]{32}$/);
            assert.deepEqual(changes, [[0, 'A', '7']]);
            assert.deepEqual(asked.filter(url => !url.endsWith('/icon.svg')), []); // browsers ask for the icon of a new address
        },
    });
});

test('a value that the script does not accept is reported, and the script runs on with the last one', options, () => opened('', {
    use: async page => {
        await shown(page, 'let Q=Q or 1 -- 0..4\n!counter state=:c rate=1\n!window size=64;8\n    !canvas\n'
            + '        !rect size=8*Q;8 color=1;0;0 fill=true\n');
        const slider = page.locator('#parameters input[type=range]'), values = () => page.evaluate(() =>
            [...document.querySelectorAll('#parameters input')].map(({ value }) => value));
        const rejected = () => page.waitForFunction(() => /Q=0 has no effect/.test(document.getElementById('problems').textContent)
            && [...document.querySelectorAll('#parameters input')].every(({ value }) => value !== '0'));
        await slider.focus();
        await page.keyboard.press('Home');
        await rejected();
        assert.match(await page.textContent('#message'), /Q=0 has no effect/);
        assert.match(await page.textContent('#problems'), /let Q=Q if Q != null else 1/);
        assert.deepEqual(await values(), ['1', '1']);
        await page.keyboard.press('End');
        await page.waitForFunction(() => document.getElementById('parameter-Q').value === '4');
        await page.click('#run');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 5);
        await page.fill('#parameter-Q', '0');
        await page.press('#parameter-Q', 'Enter');
        await page.waitForFunction(() => document.getElementById('parameter-Q').value === '4');
        assert.equal(await page.textContent('#run'), 'Pause');
        const frame = await page.evaluate(() => Number(document.body.dataset.frame));
        await page.waitForFunction(before => Number(document.body.dataset.frame) > before + 5, frame);
    },
}));

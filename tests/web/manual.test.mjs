// manual.test.mjs: tests the manual's site: examples give the same results in WebAssembly, links and images exist, the search works, and
// pages run their examples. Skipped without the site or the browser.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { loadEngine } from '../../src/web/engine/petri.mjs';
import { outcome } from '../../src/web/site/try.mjs';
import { folder, options, pixels, root, visited, world } from './browser.mjs';

const site = join(folder, 'manual'), built = { skip: existsSync(join(site, 'index.html')) ? false : 'missing: the manual' };
const pages = built.skip ? [] : readdirSync(site).filter(name => name.endsWith('.html'));
const read = name => readFileSync(join(site, name), 'utf8');
const AXE = join(root, 'src/web/page/node_modules/axe-core/axe.min.js');

// Checks that the expected lines KEY = VALUE occur, in any order and among others. null: the key must not exist.
function hasState(printed, wanted) {
    const lines = printed.split('\n');
    return wanted.trimEnd().split('\n').every(line => line.endsWith(' = null')
        ? !lines.some(other => other.startsWith(`${line.slice(0, -4)}`)) : lines.includes(line));
}

test('examples give in WebAssembly the results of the manual', built, async () => {
    const engine = await loadEngine(readFileSync(join(folder, 'petri/engine.wasm'))), examples = JSON.parse(read('examples.json'));
    for (const example of examples) {
        const { page, kind, text, result, files } = example, where = `${page}: ${text}`;
        if (kind === 'dish') {
            const session = engine.open({ files });
            session.load(text);
            for (let i = 0; i < 3; i++)
                session.step();
            assert.ok(session.displayList().numbers.length > 2, where);
            session.close();
            continue;
        }
        const given = outcome(engine, example);
        if (kind === 'state')
            assert.ok(hasState(given, result), `${where}\n${given}`);
        else if (kind === 'eval')
            given.split('\n').forEach((line, i) => {
                const wanted = result.split('\n')[i];
                if (wanted !== 'error')
                    assert.equal(line, wanted, text.split('\n')[i]);
            });
        else
            assert.ok(given.startsWith(result.trimEnd()), `${where}\n${given}`);
    }
    const count = kind => examples.filter(example => example.kind === kind).length;
    const counts = { dish: count('dish'), eval: count('eval'), tree: count('tree'), state: count('state') };
    assert.ok(counts.dish > 40 && counts.eval > 20 && counts.tree > 30 && counts.state > 15, JSON.stringify(counts));
});

test('links and pictures exist', built, () => {
    const idsOf = name => [...read(name).matchAll(/ id="([^"]+)"/g)].map(([, id]) => id);
    const ids = new Map(pages.map(name => [name, new Set(idsOf(name))]));
    let count = 0;
    for (const name of pages) {
        const text = read(name), twice = idsOf(name).filter((id, i, all) => all.indexOf(id) !== i);
        assert.deepEqual(twice, [], `${name}: ids that are there twice`);
        for (const [, link] of text.matchAll(/(?:href|src)="([^"]*)"/g)) {
            const [path, id] = link.split('#');
            if (/^[a-z]+:/.test(link))
                continue;
            count++;
            assert.ok(!path || existsSync(join(site, path)), `${name}: ${link}`);
            assert.ok(id === undefined || (ids.get(path || name) ?? new Set()).has(decodeURIComponent(id)), `${name}: ${link}`);
        }
    }
    assert.ok(pages.length > 18 && count > 1000, `${pages.length} pages, ${count} links`);
});

const FORCES = ['distance', 'collision', 'gravity', 'electrostatic', 'adhesion', 'constant', 'random', 'field', 'drag', 'buoyancy',
    'barrier'];

test('each physics node has an example that runs, and forces have a formula', built, () => {
    const { nodes } = JSON.parse(readFileSync(join(folder, '../web-tables.json'), 'utf8')), text = read('physics.html');
    for (const { name } of nodes.filter(({ area }) => area === 'physics')) {
        const part = text.split(`<h2 id="${name}">`)[1]?.split('<h2 ')[0];
        assert.match(part ?? '', /<petri-dish controls editor/, name);
        assert.equal(/class="formula"/.test(part), FORCES.includes(name), name);
    }
});

const visit = (name, use, settings = {}) =>
    visited(`${world.server.url}manual/${name}`, { settings, ready: () => document.readyState === 'complete', use });
const shown = page => page.waitForFunction(() => document.querySelector('petri-dish').frame >= 0);

const ways = { ...options, skip: options.skip || built.skip };

test('the search works with the keyboard, and pages show their examples', ways, () => visit('index.html', async page => {
    await shown(page);
    assert.ok((await pixels(page, 'petri-dish >> #picture')).all > 20);
    await page.keyboard.press('/');
    await page.keyboard.type('collision');
    await page.waitForSelector('#found a');
    assert.equal(await page.textContent('#found a'), 'Physics: !collision');
    const [field, results] = [await page.locator('#find').boundingBox(), await page.locator('#found').boundingBox()];
    assert.ok(Math.abs(results.x - field.x) < 5 && results.y >= field.y + field.height, 'results are below the field');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await page.waitForURL(/physics\.html#collision$/);
    const dish = page.locator('h2#collision + petri-dish');
    await page.waitForFunction(() => document.querySelector('h2#collision + petri-dish').frame >= 0);
    const { sum, all } = await pixels(page, 'h2#collision + petri-dish >> #picture');
    assert.ok(all > 20);
    await dish.locator('#parameter-STRENGTH').fill('20');
    await dish.locator('#step').click();
    await page.waitForFunction(() => document.querySelector('h2#collision + petri-dish').frame === 3);
    assert.notEqual((await pixels(page, 'h2#collision + petri-dish >> #picture')).sum, sum);
    await page.fill('#find', 'petri_open');
    await page.waitForFunction(() => document.querySelector('#found a')?.textContent.endsWith('petri_open'));
    await page.fill('#find', 'xyzzyx');
    await page.waitForFunction(() => document.getElementById('found').textContent === 'No results.');
}));

test('a reader can change an example and sees the new result', ways, () => visit('language.html', async page => {
    const example = page.locator('.try[data-kind=eval]').first();
    await example.locator('button').click();
    await example.locator('textarea').fill('1+2\n..4\nnonsense(');
    await page.waitForFunction(() => document.querySelector('.try[data-kind=eval] .result').textContent.startsWith('3\n0;1;2;3\n'));
    const script = page.locator('.try[data-kind=tree]').first();
    await script.locator('button').click();
    await script.locator('textarea').fill('for i in ..2\n    !a b=i c=nowhere\n');
    await page.waitForFunction(() => /^!a b=0\n!a b=1\n.*unbound name 'nowhere'/s
        .test(document.querySelector('.try[data-kind=tree] .result').textContent));
}));

test('pages are accessible, in light and dark, on a phone, and offline', ways, async () => {
    for (const [name, colorScheme] of [['physics.html', 'light'], ['language.html', 'dark']])
        await visit(name, async page => {
            await page.evaluate(readFileSync(AXE, 'utf8'));
            const { violations } = await page.evaluate(() => globalThis.axe.run());
            assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes[0].html]), [], name);
        }, { colorScheme });
    await visit('tutorial.html', async (page, context) => {
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
        await page.waitForFunction(() => navigator.serviceWorker.controller);
        await page.evaluate(async () => {
            while (!await caches.match('tutorial.html'))
                await new Promise(resolve => setTimeout(resolve, 20));
        });
        await page.waitForLoadState('networkidle'); // requests that are under way would fail
        await context.setOffline(true);
        await page.goto(`${world.server.url}manual/functions.html`);
        await page.fill('#find', 'hypot');
        await page.waitForFunction(() => /hypot/.test(document.querySelector('#found a')?.textContent));
    }, { viewport: { width: 390, height: 800 } });
});

test('a page opened from a file has text, pictures and search', ways, () => visited(`${pathToFileURL(join(site, 'physics.html'))}`, {
    expected: /CORS|Failed to load/, ready: () => document.readyState === 'complete', use: async page => {
        assert.ok(await page.isVisible('#served'));
        assert.match(await page.textContent('#collision + petri-dish > pre'), /!collision strength=STRENGTH/);
        assert.ok(await page.isVisible('#collision + petri-dish > pre'));
        await page.fill('#find', 'collision');
        await page.waitForSelector('#found a');
        assert.equal(await page.textContent('#found a'), 'Physics: !collision');
    },
}));

// site.test.mjs: tests each page of the manual: its content, and that its dishes run. manual.test.mjs tests what all pages have in common.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { folder, options, pixels, root, visited, world } from './browser.mjs';

const site = join(folder, 'manual'), missing = existsSync(join(site, 'index.html')) ? false : 'missing: the manual';
const built = { skip: missing }, ways = { ...options, skip: options.skip || missing, timeout: 180000 };
const read = name => readFileSync(join(site, name), 'utf8');
const visit = (name, use, settings = {}) =>
    visited(`${world.server.url}manual/${name}`, { settings, ready: () => document.readyState === 'complete', use });

const plain = html => html.replaceAll(/<[^>]*>/g, '').replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&quot;', '"')
    .replaceAll('&amp;', '&');

// Visits each dish of the page. Collects its message and the number of different bytes in its picture, which is above two if it has several
// colours.
async function eachDish(page, look, frames = 4) {
    const count = await page.locator('petri-dish').count();
    for (let i = 0; i < count; i++) {
        const dish = page.locator('petri-dish').nth(i);
        await dish.evaluate(element => element.closest('details')?.setAttribute('open', ''));
        await dish.scrollIntoViewIfNeeded();
        const at = await dish.evaluate(async (element, wanted) => {
            const message = () => element.shadowRoot?.getElementById('message')?.textContent ?? '';
            while (element.frame < 0 && !message())
                await new Promise(resolve => setTimeout(resolve, 20));
            const first = element.frame;
            if (first >= 0)
                await element.seek(first + wanted);
            return { frame: element.frame - first, message: message(), label: element.getAttribute('label') };
        }, frames);
        const colours = await dish.locator('#picture').evaluate(canvas => {
            const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
            return new Set(new Uint32Array(data.buffer)).size;
        });
        await look({ ...at, colours, dish });
    }
    return count;
}

function runsWell({ frame, message, label, colours }) {
    assert.equal(message, '', label);
    assert.equal(frame, 4, label);
    assert.ok(colours > 1, `${label}: all of one colour`);
}

test('ten steps of the tutorial run; the last two are about tests and the prompt', ways, () => visit('tutorial.html', async page => {
    const steps = [...read('tutorial.html').matchAll(/<h2 id="[^"]*">(\d+)\. (.*?) <a[^]*?(?=<h2|<\/main>)/g)];
    assert.deepEqual(steps.map(([, number]) => Number(number)), [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
    assert.match(steps[0][2], /particle/);
    for (const [part, number] of steps.slice(0, 10))
        assert.equal(part.match(/<petri-dish /g)?.length, 1, `step ${number}`);
    assert.match(steps[9][0].replaceAll(/<[^>]*>/g, ''), /!anchor id=:(dish|middle|centre)/);
    assert.equal(await eachDish(page, runsWell), 10);
}, { reducedMotion: 'reduce' }));

test('the tutorial begins with a dish that moves, and without the terminal', ways, () => visit('tutorial.html', async page => {
    const start = read('tutorial.html').match(/<h1[^]*?<h2/)[0];
    assert.doesNotMatch(start, /terminal|\.\/dev|petri view/);
    await page.waitForFunction(() => document.querySelector('petri-dish').frame > 5);
    const { sum } = await pixels(page, 'petri-dish >> #picture');
    await page.waitForFunction(() => document.querySelector('petri-dish').frame > 30);
    assert.notEqual((await pixels(page, 'petri-dish >> #picture')).sum, sum);
    assert.equal(await page.locator('petri-dish').nth(1).evaluate(dish => dish.running), false);
}, { reducedMotion: 'no-preference' }));

test('each sample is in the gallery, draws, and has its script', ways, () => visit('gallery.html', async page => {
    const samples = readdirSync(join(root, 'samples')).filter(name => name.endsWith('.fl')), seen = [];
    await eachDish(page, async what => {
        const { dish } = what, name = await dish.getAttribute('src');
        seen.push(name);
        runsWell(what);
        const script = readFileSync(join(root, 'samples', name), 'utf8');
        assert.equal(read(name), script);
        assert.equal(await dish.evaluate(element => element.text), script);
        const shown = await dish.evaluate(({ nextElementSibling: below }) => below.matches('details') ? below.textContent : '');
        assert.ok(shown.includes(script), name);
        assert.ok(await dish.locator('#open').isVisible(), name);
    });
    assert.deepEqual(seen, samples);
}));

test('the differences from Flitter are documented, and the example runs', ways, () => visit('index.html', async page => {
    await page.locator('main .cards a', { hasText: 'Flitter' }).click();
    await page.waitForURL(/flitter\.html$/);
    const text = await page.textContent('main');
    for (const part of ['Language', 'Three dimensions', 'What differs'])
        assert.ok(text.includes(part), part);
    const reported = [];
    assert.equal(await eachDish(page, ({ message, colours }) => reported.push([message.split('\n')[0], colours > 1])), 1);
    const [, warning] = read('flitter.html').replaceAll(/<[^>]*>/g, '').match(/^films\.(fl:2:5: warning: .*)$/m);
    assert.deepEqual(reported, [[`script.${warning}`, true]]);
}));

test('each physics node has its attributes with units, and a dish that runs', ways, () => visit('physics.html', async page => {
    const { nodes } = JSON.parse(readFileSync(join(folder, '../web-tables.json'), 'utf8')), all = read('nodes.html');
    // Symbols in formulas, and units.
    assert.match(all, /the unit of F is mass·length\/time²/);
    const units = plain(read('physics.html').split('<h2 id="units-and-axes">')[1].split('<h2 ')[0]);
    for (const quantity of ['time', 'length', 'mass', 'charge', 'velocity', 'force'])
        assert.ok(units.includes(`\n${quantity}\n`), quantity);
    const ours = nodes.filter(({ area }) => area === 'physics');
    assert.ok(ours.length > 14);
    for (const { name, attributes } of ours) {
        const here = read('physics.html').split(`<h2 id="${name}">`)[1].split('<h2 ')[0];
        const there = all.split(`<h3 id="physics-${name}">`)[1].split(/<h[23] /)[0];
        for (const attribute of attributes) {
            const reported = here.includes(`<code>${attribute.name}</code>`);
            assert.ok(reported || /^(min|max)(imum)?$|^fixed$/.test(attribute.name), `${name} ${attribute.name}`);
            const row = there.split('<tr>').find(one => one.startsWith(`<td><code>${attribute.name}</code></td>`)) ?? '';
            const cells = row.split('<td>').slice(1).map(plain).map(cell => cell.trim());
            assert.deepEqual(cells.slice(0, 3), [attribute.name, attribute.type, attribute.unit], `${name} ${attribute.name}`);
        }
    }
    await eachDish(page, runsWell);
}));

test('all other dishes run and show the documented results', ways, async () => {
    const done = ['tutorial', 'gallery', 'flitter', 'physics'];
    for (const name of readdirSync(site).filter(file => file.endsWith('.html') && !done.includes(file.slice(0, -5)))) {
        if (!read(name).includes('<petri-dish '))
            continue;
        const text = plain(read(name));
        await visit(name, page => eachDish(page, ({ message, label, frame }) => {
            for (const [, said] of message.matchAll(/^script\.(fl:.*)$/gm))
                assert.ok(text.includes(said), `${name}: ${label}: ${said}`);
            assert.ok(message === '' || message.startsWith('script.fl:'), `${name}: ${label}: ${message}`);
            assert.equal(frame, 4, `${name}: ${label}`);
        }));
    }
});

test('each page is linked from the first page and from all others', built, () => {
    const pages = readdirSync(site).filter(name => name.endsWith('.html'));
    const links = name => [...read(name).matchAll(/<a href="([^"#]*)/g)].map(([, to]) => to);
    const reached = new Set(['index.html']);
    for (const name of reached)
        links(name).filter(to => pages.includes(to)).forEach(to => reached.add(to));
    assert.deepEqual([...reached].sort(), pages);
    const cards = read('index.html').split('class="cards"').slice(1).join('');
    for (const name of pages.filter(page => page !== 'index.html')) {
        assert.ok(cards.includes(`<a href="${name}">`), `${name} is not on the first page`);
        assert.equal(read(name).match(/aria-current="page"/g)?.length, 1, name);
        for (const other of pages)
            assert.ok(read(other).includes(`<a href="${name}"`), `${name} is not on ${other}`);
    }
});

const INDEX = `${pathToFileURL(join(site, 'index.html'))}`;

// The page is opened from a file, without a server.
test('each page is found by its title, and each section is in the index', ways, () => visited(INDEX, {
    expected: /CORS|Failed to load/, ready: () => document.readyState === 'complete', use: async page => {
        const titles = [...read('index.html').split('class="cards"').slice(1).join('').matchAll(/<a href="([^"]*)">([^<]*)<\/a>/g)];
        assert.ok(titles.length > 18);
        for (const [, name, title] of titles) {
            await page.fill('#find', '');
            await page.fill('#find', title);
            await page.waitForFunction(wanted => [...document.querySelectorAll('#found a')].some(link =>
                link.getAttribute('href').startsWith(`${wanted}#`)), name);
        }
        const sections = await page.evaluate(() => {
            const { pages, sections: all } = globalThis.PETRI_INDEX;
            return all.map(([number, , id]) => `${pages[number][0]}#${id}`);
        });
        for (const [, name] of titles)
            for (const [, id] of read(name).matchAll(/<h[1-3] id="([^"]*)"/g))
                assert.ok(sections.includes(`${name}#${id}`) || id === 'top', `${name}#${id}`);
    },
}));

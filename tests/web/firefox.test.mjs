// firefox.test.mjs: the page in Firefox: it shows the first dish and runs it, and the engine gives the bits of the native build.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { frameOf, options, pixels, root, world } from './browser.mjs';

const FIREFOX = '/usr/bin/firefox-esr';
const petri = join(root, 'build/src/petri');
const missing = [FIREFOX, petri].find(path => !existsSync(path));
const skip = options.skip || (missing && `missing: ${missing}`);
// Playwright's other protocol needs a Firefox of theirs. The unset features cannot be emulated through WebDriver BiDi.
const CONTEXT = { viewport: { width: 1280, height: 800 }, colorScheme: null, reducedMotion: null, forcedColors: null, contrast: null };

test('Firefox shows and runs the first dish', { skip, timeout: 180000 }, async () => {
    const { firefox } = await import(pathToFileURL(join(root, 'src/web/page/node_modules/playwright-core/index.mjs')));
    const browser = await firefox.launch({ executablePath: FIREFOX, channel: 'moz-firefox', headless: true });
    try {
        const page = await (await browser.newContext(CONTEXT)).newPage(), said = [];
        page.setDefaultTimeout(120000);
        page.on('console', message => said.push(message.text()));
        page.on('pageerror', error => said.push(error.message));
        await page.goto(world.server.url);
        await page.waitForFunction(() => document.body.dataset.ready);
        const first = await frameOf(page);
        if (await page.textContent('#run') === 'Run')
            await page.click('#run');
        await page.waitForFunction(then => Number(document.body.dataset.frame) > then + 10, first);
        const { width, all } = await pixels(page);
        assert.ok(width > 100 && all > 20, `${width} pixels wide, ${all} values`);
        const script = readFileSync(join(root, 'samples/dish.fl'), 'utf8');
        const hash = await page.evaluate(async source => {
            const { loadEngine } = await import('./petri/petri.mjs');
            const session = (await loadEngine()).open();
            session.load(source);
            for (let i = 0; i < 60; i++)
                session.step();
            return session.digest();
        }, script);
        const native = execFileSync(petri, ['run', '-', '--frames', '60', '--print', 'digest'], { input: script, encoding: 'utf8' });
        assert.equal(native.trim().split('= ').at(-1), hash);
        assert.deepEqual(said, []);
    } finally {
        await browser.close();
    }
});

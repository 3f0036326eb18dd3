// firefox.test.mjs: the page in Firefox: it shows the first dish and runs it, and the engine gives the bits of the native build.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { firefoxOptions, frameOf, openedInFirefox, pixels, root } from './browser.mjs';

const petri = join(root, 'build/src/petri');
const beside = { ...firefoxOptions, skip: firefoxOptions.skip || (existsSync(petri) ? false : `missing: ${petri}`) };

test('Firefox shows and runs the first dish', beside, () => openedInFirefox(async page => {
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
}));

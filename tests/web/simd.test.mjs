// simd.test.mjs: browsers and Node.js without WebAssembly SIMD load another engine, which has the same results. tests/web/run.sh compares
// all hashes of this engine with those of the other builds.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { atFrame, cachedEngines, folder, frameOf, opened, options, root, says, visited, world } from './browser.mjs';

// V8 then takes the processor for one without SSE4.1, in pages, workers and service workers.
const FLAG = '--no-enable-sse4-1';
world.flags = [`--js-flags=${FLAG}`];
const petri = join(root, 'build/petri'), scratch = mkdtempSync(join(tmpdir(), 'petri-')), script = join(root, 'samples/dish.fl');
const missing = process.arch !== 'x64' ? 'V8 can disable SIMD only on x86' : existsSync(petri) ? false : `missing: ${petri}`;
const without = { ...options, skip: options.skip || missing };
after(() => rmSync(scratch, { recursive: true }));

const digestOf = frame => execFileSync(petri, ['run', script, '--frames', `${frame + 1}`, '--every', `${frame}`, '--print', 'digest'],
    { encoding: 'utf8' }).match(/[0-9a-f]{32}(?=\n*$)/)[0];

// Collects the names of the engines that a page loads.
const watch = page => {
    page.engines = [];
    page.on('request', request => /engine[^/]*\.wasm$/.test(request.url()) && page.engines.push(request.url().replace(/.*\//, '')));
};

test('without SIMD, the page runs with the other engine, online and offline, and loads only this one', without, () => opened('', {
    prepare: watch,
    use: async (page, context) => {
        const check = async () => {
            await page.fill('#line', '.goto 60');
            await page.press('#line', 'Enter');
            await atFrame(page, 60);
            await page.click('#tab-state');
            await page.waitForFunction(() => /digest [0-9a-f]{32}/.test(document.getElementById('state-digest').textContent));
            assert.equal(await page.textContent('#state-digest'), `digest ${digestOf(60)}`);
            await page.click('#tab-prompt');
        };
        await check();
        await page.waitForFunction(() => navigator.serviceWorker.controller);
        await page.waitForLoadState('networkidle');
        assert.deepEqual(await cachedEngines(page), ['engine-scalar.wasm']);
        await context.setOffline(true);
        await page.reload();
        await page.waitForFunction(() => document.body.dataset.ready);
        await check();
        assert.deepEqual([...new Set(page.engines)], ['engine-scalar.wasm']);
    },
}));

test('without SIMD, the page says why it cannot open an archive, and still runs the script', without, () => opened('', {
    prepare: watch,
    use: async page => {
        const file = join(scratch, 'run.petri');
        execFileSync(petri, ['run', script, '--frames', '3', '--archive', file, '--quiet']);
        await page.setInputFiles('#file', file);
        await says(page, /archives need WebAssembly SIMD, which this browser lacks/);
        const before = await frameOf(page);
        await page.click('#step');
        await atFrame(page, before + 1);
        assert.deepEqual([...new Set(page.engines)], ['engine-scalar.wasm']);
    },
}));

test('without SIMD, the tour, examples of the manual and <petri-dish> run, and a page of petri link --html says why it does not', without,
    async () => {
        const loadsOne = { prepare: watch };
        await visited(`${world.server.url}tour/film.html`, {
            ...loadsOne, ready: () => document.body.dataset.task,
            use: page => assert.deepEqual([...new Set(page.engines)], ['engine-scalar.wasm']),
        });
        await visited(`${world.server.url}manual/physics.html`, {
            ...loadsOne, ready: () => document.querySelector('petri-dish'),
            use: async page => {
                await page.evaluate(() => document.querySelector('petri-dish').run());
                await page.waitForFunction(() => document.querySelector('petri-dish').frame > 4);
                assert.deepEqual([...new Set(page.engines)], ['engine-scalar.wasm']);
            },
        });
        const file = join(scratch, 'dish.html');
        const env = { ...process.env, PETRI_STANDALONE: join(folder, 'standalone.html') };
        execFileSync(petri, ['link', script, '--html', file], { env });
        await visited(`${pathToFileURL(file)}`, {
            ready: () => document.getElementById('message').textContent,
            use: async page => assert.match(await page.textContent('#message'), /needs WebAssembly SIMD, which this browser lacks/),
        });
    });

test('Node.js without SIMD loads the other engine by itself', { skip: missing }, () => {
    const code = `const { engineFile, loadEngine } = await import(${JSON.stringify(`${pathToFileURL(join(folder, 'petri/petri.mjs'))}`)});
        const text = (await import('node:fs')).readFileSync(${JSON.stringify(script)}, 'utf8');
        const session = (await loadEngine()).open();
        session.load(text, 'dish.fl');
        for (let i = 0; i <= 60; i++)
            session.step();
        console.log(engineFile(), session.digest());`;
    const run = (...flags) => execFileSync(process.execPath, [...flags, '--input-type=module', '-e', code], { encoding: 'utf8' }).trim();
    assert.equal(run(FLAG), `engine-scalar.wasm ${digestOf(60)}`);
    assert.equal(run(), `engine.wasm ${digestOf(60)}`);
});

// pictures.test.mjs: the page shows what `petri render` draws: within 2 bytes, edges and letters within a pixel. Skipped
// where npm's modules, the browser or a petri that draws are not.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const folder = process.env.PETRI_WEB, browserPath = '/usr/bin/chromium', petri = join(root, 'build/src/petri');
const modules = join(root, 'src/web/page/node_modules/playwright-core/index.mjs');
const drawer = join(root, 'build/src/petri-pictures');
const missing = [modules, browserPath, join(folder, 'page.js'), petri, drawer].find(path => !existsSync(path));
const options = { skip: missing ? `there is no ${missing}` : false, timeout: 60000 };
const scratch = mkdtempSync(join(tmpdir(), 'petri-pictures-'));
let browser, server, page;

before(async () => {
    if (missing)
        return;
    const { chromium } = await import(pathToFileURL(modules));
    const { serve } = await import('../../src/web/page/serve.mjs');
    server = await serve(folder);
    browser = await chromium.launch({
        executablePath: browserPath,
        args: ['--headless', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
            '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
    });
    page = await browser.newPage();
    await page.goto(server.url);
    await page.waitForFunction(() => document.body.dataset.ready);
});

after(async () => {
    await browser?.close();
    server?.close();
    rmSync(scratch, { recursive: true });
});

// How many pixels of either picture are not what the other one has within a pixel around, and 2 bytes.
function compare(png) {
    const outside = (a, b, width, height) => {
        let count = 0;
        for (let y = 0; y < height; y++)
            for (let x = 0; x < width; x++) {
                let bad = false;
                for (let k = 0; k < 3; k++) {
                    let least = 255, most = 0;
                    for (let v = Math.max(y - 1, 0); v <= Math.min(y + 1, height - 1); v++)
                        for (let u = Math.max(x - 1, 0); u <= Math.min(x + 1, width - 1); u++) {
                            const byte = b[4 * (v * width + u) + k];
                            least = Math.min(least, byte);
                            most = Math.max(most, byte);
                        }
                    const byte = a[4 * (y * width + x) + k];
                    bad ||= byte < least - 2 || byte > most + 2;
                }
                count += bad;
            }
        return count;
    };
    return createImageBitmap(new Blob([Uint8Array.from(atob(png), c => c.charCodeAt(0))])).then(image => {
        const canvas = document.getElementById('picture'), { width, height } = canvas;
        if (image.width !== width || image.height !== height)
            return { size: [width, height], wanted: [image.width, image.height] };
        const other = new OffscreenCanvas(width, height).getContext('2d');
        other.drawImage(image, 0, 0);
        const here = canvas.getContext('2d').getImageData(0, 0, width, height).data;
        const there = other.getImageData(0, 0, width, height).data;
        return { here: outside(here, there, width, height), there: outside(there, here, width, height), colours: new Set(here).size };
    });
}

// A page does not hear of a file that is opened again.
async function shown(script, text, frame) {
    writeFileSync(script, text);
    await page.evaluate(() => delete document.body.dataset.frame);
    await page.setInputFiles('#file', script);
    await page.waitForFunction(() => document.body.dataset.frame === '2');
    if (frame !== 2) {
        await page.evaluate(wanted => {
            const time = document.getElementById('time');
            Object.assign(time, { max: wanted, value: wanted });
            time.dispatchEvent(new Event('input'));
        }, frame);
        await page.waitForFunction(wanted => document.body.dataset.frame === String(wanted), frame);
    }
}

async function check(name, text, frame) {
    const script = join(scratch, `${name}.fl`), png = join(scratch, 'picture.png');
    await shown(script, text, frame);
    assert.equal(await page.textContent('#message'), '', name);
    execFileSync(petri, ['render', script, '--quiet', '--frame', String(frame), '-o', png], { stdio: 'pipe' });
    const { here, there, colours, ...sizes } = await page.evaluate(compare, readFileSync(png).toString('base64'));
    assert.deepEqual([here, there, sizes], [0, 0, {}], name);
    assert.ok(colours > 2, `${name} has ${colours} bytes only`);
}

test('three dimensions', options, () => check('a sphere', `!window size=200;150
    !canvas3d viewpoint=0;2;5 focus=0;0;0
        !light direction=-1;-1;-1 color=1
        !sphere size=1 color=1;0.3;0.1
`, 2));

test('effects', options, () => check('bloom', `!window size=120;80
    !bloom radius=8
        !canvas
            !ellipse point=40+10*frame;40 radius=20 color=1;0.8;0.2 fill=true
`, 3));

test('pictures over each other', options, () => check('two canvases', `!window size=120;80
    !canvas
        !rect point=10;10 size=60;40 color=0.2;0.4;1 fill=true
    !canvas
        !rect point=40;30 size=60;40 color=1;0;0;0.5 fill=true
`, 2));

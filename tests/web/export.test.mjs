// export.test.mjs: files that the page saves: text, images, videos, tables.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { atFrame, opened, options, root, typed } from './browser.mjs';

const petri = join(root, 'build/src/petri');

// Exports through the dialog. Returns the name and the path of the file.
async function exported(page, kind, to) {
    await page.click('#save-as');
    await page.check(`#saving input[value=${kind}]`);
    if (to !== undefined)
        await page.fill('#saving-to', String(to));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#saving-go')]);
    await page.waitForSelector('#saving', { state: 'hidden' });
    return { name: download.suggestedFilename(), path: await download.path() };
}

test('text, picture and state are saved as files', options, () => opened('', {
    use: async page => {
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
        assert.equal(download.suggestedFilename(), 'dish.fl');
        assert.ok(readFileSync(await download.path(), 'utf8').startsWith('-- '));
        const picture = await exported(page, 'picture');
        assert.equal(picture.name, 'dish-2.png');
        assert.ok(readFileSync(picture.path, 'latin1').startsWith('\x89PNG'));
        const state = await exported(page, 'state');
        assert.equal(state.name, 'dish-2.csv');
        assert.match(readFileSync(state.path, 'utf8'), /^key,value\n(:?[^\n]*,[^\n]+\n){9}/);
    },
}));

const beside = { ...options, skip: options.skip || (existsSync(petri) ? false : `missing: ${petri}`) };

test('particles are saved as by petri run --trajectory', beside, () => opened('', {
    use: async page => {
        const scratch = mkdtempSync(join(tmpdir(), 'petri-')), way = join(scratch, 'run.csv');
        execFileSync(petri, ['run', join(root, 'samples/dish.fl'), '--frames', '25', '--trajectory', way, '--quiet', '--print', 'state']);
        const { name, path } = await exported(page, 'particles', 24);
        assert.equal(name, 'dish.csv');
        assert.equal(readFileSync(path, 'utf8'), readFileSync(way, 'utf8'));
        rmSync(scratch, { recursive: true });
        await atFrame(page, 2); // the frame that was shown before the export
    },
}));

test('a video has one frame per frame of the script, with the right colours', options, () => opened('', {
    use: async (page, context) => {
        await typed(page, '%pragma fps 25\n!window size=101;51\n    !canvas\n'
            + '        !rect point=0;0 size=(frame+1);51 color=1;0.5;0 fill=true\n');
        await page.click('#run');
        await page.waitForFunction(() => document.getElementById('picture').width === 101);
        await page.click('#run');
        const { name, path } = await exported(page, 'film', 90);
        assert.equal(name, 'dish.webm');
        const film = readFileSync(path), blocks = film.toString('latin1').match(/\xa3\x01\0{5}[^]{2}\x81/g).length;
        assert.equal(blocks, 91);
        // The browser plays the video. In the middle of frame 49, at 25 frames per second, it shows 50 columns.
        const cinema = await context.newPage();
        const seen = await cinema.evaluate(async text => {
            const video = document.createElement('video');
            const bytes = Uint8Array.from(atob(text), character => character.charCodeAt(0));
            video.src = URL.createObjectURL(new Blob([bytes], { type: 'video/webm' }));
            await new Promise((resolve, reject) => {
                video.onloadeddata = resolve;
                video.onerror = () => reject(new Error(video.error.message));
            });
            video.currentTime = 49.5 / 25;
            await new Promise(resolve => (video.onseeked = resolve));
            const context = new OffscreenCanvas(101, 51).getContext('2d');
            context.drawImage(video, 0, 0);
            const at = x => [...context.getImageData(x, 25, 1, 1).data].slice(0, 3);
            const { duration, videoWidth, videoHeight } = video;
            return { duration, size: [videoWidth, videoHeight], inside: at(40), outside: at(60), edge: [at(48), at(51)] };
        }, film.toString('base64'));
        assert.ok(Math.abs(seen.duration - 91 / 25) < 0.01, `${seen.duration}`);
        assert.deepEqual(seen.size, [101, 51]);
        const near = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 40);
        assert.ok(near(seen.inside, [255, 128, 0]) && near(seen.outside, [0, 0, 0]), JSON.stringify(seen));
        assert.ok(near(seen.edge[0], [255, 128, 0]) && near(seen.edge[1], [0, 0, 0]), JSON.stringify(seen));
    },
}));

test('without WebCodecs, exporting a video is an error, and the page continues', options, () => opened('', {
    prepare: page => page.route('**/worker.js', async route => {
        const response = await route.fetch();
        await route.fulfill({ response, body: `delete globalThis.VideoEncoder;${await response.text()}` });
    }),
    use: async page => {
        await page.click('#save-as');
        await page.check('#saving input[value=film]');
        await page.fill('#saving-to', '9');
        await page.click('#saving-go');
        await page.waitForFunction(() => document.getElementById('export-status').textContent);
        assert.match(await page.textContent('#message'), /cannot make videos: this browser has no encoder/);
        await page.keyboard.press('Escape');
        await atFrame(page, 2);
        await page.click('#step');
        await atFrame(page, 3);
    },
}));

test('an export can be cancelled', options, () => opened('', {
    use: async page => {
        await page.click('#save-as');
        await page.check('#saving input[value=particles]');
        await page.fill('#saving-to', '900000');
        await page.click('#saving-go');
        await page.waitForSelector('#saving-progress', { state: 'visible' });
        await page.click('#saving-cancel');
        await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('Stopped'));
        await page.waitForFunction(() => document.getElementById('export-status').textContent);
        await atFrame(page, 2);
        await page.click('#step');
        await atFrame(page, 3);
    },
}));

test('scripts, modules and images can be opened and dropped', options, () => opened('', {
    use: async page => {
        const script = "import WIDE from 'wide.fl'\n!window size=WIDE;20\n    !canvas\n"
            + "        !image filename='red.png' point=0;0 size=WIDE;20\n";
        const red = Buffer.from(await page.evaluate(async () => {
            const canvas = new OffscreenCanvas(2, 2), context = canvas.getContext('2d');
            context.fillStyle = '#f00';
            context.fillRect(0, 0, 2, 2);
            return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
        }));
        const files = width => [['wide.fl', `let WIDE=${width}\n`], ['red.png', red], ['main.fl', script]];
        const at = () => page.evaluate(() => [...document.getElementById('picture').getContext('2d').getImageData(5, 5, 1, 1).data]);
        const wide = width => page.waitForFunction(wanted =>
            document.getElementById('picture').width === wanted && document.body.dataset.frame === '2', width);
        await page.setInputFiles('#file', files(40).map(([name, content]) => ({ name, mimeType: '', buffer: Buffer.from(content) })));
        await wide(40);
        assert.deepEqual(await at(), [255, 0, 0, 255]);
        assert.equal(await page.textContent('#problems'), '');
        await page.evaluate(dropped => {
            const data = new DataTransfer();
            for (const [name, text] of dropped)
                data.items.add(new File([text], name));
            document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
        }, files(50).slice(0, 1));
        await wide(50); // the open script runs again, with the dropped module
        assert.deepEqual(await at(), [255, 0, 0, 255]);
        assert.match(await page.textContent('.cm-content'), /^import WIDE/);
    },
}));

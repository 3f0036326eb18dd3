// export.test.mjs: files that the page saves: text, images, videos, tables.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { atFrame, firefoxOptions, opened, openedInFirefox, options, root, typed } from './browser.mjs';

const petri = join(root, 'build/src/petri');

// Exports through the dialog. Returns the name and the path of the file.
async function exported(page, kind, to, from = 0) {
    await page.click('#save-as');
    await page.check(`#saving input[value=${kind}]`);
    if (to !== undefined) {
        await page.fill('#saving-from', String(from));
        await page.fill('#saving-to', String(to));
    }
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

// A script whose frame N shows N + 1 orange columns of 101 in 51 rows.
const COLUMNS = rate => `%pragma fps ${rate}\n!window size=101;51\n    !canvas\n`
    + '        !rect point=0;0 size=(frame+1);51 color=1;0.5;0 fill=true\n';

async function showColumns(page, rate) {
    await typed(page, COLUMNS(rate));
    await page.click('#run');
    await page.waitForFunction(() => document.getElementById('picture').width === 101);
    await page.click('#run');
}

// Returns what ffprobe says about the first stream of a file, with its number of decoded frames, and the rows and columns of a frame as
// decoded by ffmpeg: for each pixel of the row in the middle, true if it is orange.
const PROBE = ['-v', 'error', '-count_frames', '-show_streams', '-show_format', '-of', 'json'];
const probed = path => JSON.parse(execFileSync('ffprobe', [...PROBE, path]));
function orange(path, frame, { width, height }) {
    const bytes = execFileSync('ffmpeg', ['-v', 'error', '-i', path, '-vf', `select=eq(n\\,${frame})`, '-frames:v', '1', '-f', 'rawvideo',
        '-pix_fmt', 'rgb24', '-']);
    return Array.from({ length: width }, (_, x) => bytes[(Math.floor(height / 2) * width + x) * 3] > 128);
}

const tools = spawnSync('ffprobe', ['-version']).error ? 'missing: ffmpeg' : false;
const decoded = { ...options, skip: options.skip || tools };

// kind, frames per second of the script, range, frames in the file, size, seconds
const FILMS = [
    ['webm', 25, 10, 90, 81, [101, 51], 81 / 25], ['mp4', 30, 10, 90, 81, [102, 52], 81 / 30], ['gif', 25, 10, 90, 81, [101, 51], 81 / 25],
    ['gif', 60, 3, 63, 31, [101, 51], 31 / 30], // every second frame
];
for (const [kind, rate, from, to, count, size, seconds] of FILMS)
    test(`a ${kind} of ${rate} frames a second has the chosen frames, with exact times and the right colours`, decoded, () => opened('', {
        use: async page => {
            await showColumns(page, rate);
            const { name, path } = await exported(page, kind, to, from);
            assert.equal(name, `dish.${kind}`);
            const { streams: [stream], format } = probed(path), every = Math.ceil((to - from + 1) / count);
            assert.deepEqual([Number(stream.nb_read_frames), stream.width, stream.height], [count, ...size]);
            assert.ok(Math.abs(Number(format.duration) - seconds) < 0.011, `${format.duration} s, not ${seconds} s`);
            for (const frame of [0, 1, Math.floor(count / 2), count - 1]) {
                const wanted = Math.min(from + frame * every + 1, 101), seen = orange(path, frame, stream).filter(Boolean).length;
                assert.ok(Math.abs(seen - wanted) <= (kind === 'gif' ? 0 : 2), `frame ${frame}: ${seen} columns, not ${wanted}`);
            }
        },
    }));

// Returns the bytes of an export in Firefox, whose downloads Playwright does not see.
async function exportedBytes(page, kind, to) {
    await page.evaluate(() => {
        const make = URL.createObjectURL;
        URL.createObjectURL = blob => make.call(URL, globalThis.saved = blob);
    });
    await page.click('#save-as');
    await page.check(`#saving input[value=${kind}]`);
    await page.fill('#saving-to', String(to));
    await page.click('#saving-go');
    await page.waitForSelector('#saving', { state: 'hidden' });
    return Buffer.from(await page.evaluate(async () => [...new Uint8Array(await globalThis.saved.arrayBuffer())]));
}

test('Firefox exports the same GIF as Chromium, and an MP4', { ...firefoxOptions, skip: firefoxOptions.skip || tools }, async () => {
    const { packLink } = await import('../../src/web/page/link.mjs'), scratch = mkdtempSync(join(tmpdir(), 'petri-'));
    let gif;
    await opened('', {
        use: async page => {
            await showColumns(page, 25);
            gif = readFileSync((await exported(page, 'gif', 20)).path);
        },
    });
    await openedInFirefox(async page => {
        // Firefox indents typed lines.
        await page.evaluate(link => (location.hash = link), await packLink({ text: COLUMNS(25), name: 'dish.fl' }));
        await page.waitForFunction(() => document.getElementById('picture').width === 101);
        assert.ok(gif.equals(await exportedBytes(page, 'gif', 20)));
        writeFileSync(join(scratch, 'film.mp4'), await exportedBytes(page, 'mp4', 20));
        const { streams: [stream] } = probed(join(scratch, 'film.mp4'));
        assert.deepEqual([stream.codec_name, Number(stream.nb_read_frames)], ['h264', 21]);
    });
    rmSync(scratch, { recursive: true });
});

test('without WebCodecs, the dialog says why there is no video, and the page continues', options, () => opened('', {
    prepare: page => page.route('**/worker.js*', async route => {
        const response = await route.fetch();
        await route.fulfill({ response, body: `delete globalThis.VideoEncoder;${await response.text()}` });
    }),
    use: async page => {
        await page.click('#save-as');
        await page.check('#saving input[value=mp4]');
        await page.fill('#saving-to', '9');
        await page.click('#saving-go');
        await page.waitForFunction(() => document.getElementById('export-status').textContent);
        assert.equal(await page.textContent('#export-status'),
            'cannot make MP4 videos: this browser has no encoder for H.264 (WebCodecs); choose WebM or GIF');
        await page.keyboard.press('Escape');
        await atFrame(page, 2);
        await page.click('#step');
        await atFrame(page, 3);
    },
}));

test('an export shows its progress and can be cancelled', options, () => opened('', {
    use: async page => {
        for (const kind of ['particles', 'gif', 'mp4']) {
            await page.click('#save-as');
            await page.check(`#saving input[value=${kind}]`);
            await page.fill('#saving-to', '900000');
            await page.click('#saving-go');
            await page.waitForFunction(() => document.getElementById('saving-progress').value >= 10);
            assert.equal(await page.evaluate(() => document.getElementById('saving-progress').max), 900001);
            await page.click('#saving-cancel');
            await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('Stopped'));
            await page.waitForFunction(() => document.getElementById('export-status').textContent);
            await atFrame(page, 2);
            await page.click('#step');
            await atFrame(page, 3);
            await page.click('#back');
            await atFrame(page, 2);
        }
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

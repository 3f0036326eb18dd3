// pictures.test.mjs: browsers show the pictures of `petri render`. Each byte of one picture must lie in the range of the same and the
// neighbouring pixels of the other picture, widened by 2, and vice versa. A few pixels may differ, because the coverage of corners of edges
// differs. Skipped without npm's modules, the browser or a petri that can draw.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const folder = process.env.PETRI_WEB, browserPath = '/usr/bin/chromium', petri = join(root, 'build/src/petri');
const modules = join(root, 'src/web/page/node_modules/playwright-core/index.mjs');
const drawer = join(root, 'build/src/petri-pictures');
const missing = [modules, browserPath, join(folder, 'page.js'), petri, drawer].find(path => !existsSync(path));
const options = { skip: missing ? `missing: ${missing}` : false, timeout: 60000 };
const scratch = mkdtempSync(join(tmpdir(), 'petri-pictures-'));
let browser, server, page;

const FRAME = 12;
// The fraction of pixels that may differ. In terrain, most of them are seams between shapes.
const SHARE = 1e-3, SHARES = { terrain: 1e-2, garden: 2e-3, font_on: 6e-3 };

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
    await page.evaluate(install);
});

after(async () => {
    await browser?.close();
    server?.close();
    rmSync(scratch, { recursive: true });
});

// The code that runs in the page: draws scripts with the npm package and compares the images.
async function install() {
    const { loadEngine } = await import('/petri/petri.mjs'), { drawPicture, pictureSize } = await import('/petri/drawing.mjs');
    const engine = await loadEngine('/petri/engine.wasm');
    const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
    // Returns the number of pixels of `a` that are outside the range of the same and the neighbouring pixels of `b`.
    const outside = (a, b, width, height) => {
        let count = 0;
        for (let y = 0; y < height; y++)
            for (let x = 0; x < width; x++)
                for (let k = 0; k < 3; k++) {
                    const byte = a[4 * (y * width + x) + k];
                    if (Math.abs(byte - b[4 * (y * width + x) + k]) <= 2)
                        continue;
                    let min = 255, max = 0;
                    for (let v = Math.max(y - 1, 0); v <= Math.min(y + 1, height - 1); v++)
                        for (let u = Math.max(x - 1, 0); u <= Math.min(x + 1, width - 1); u++) {
                            const other = b[4 * (v * width + u) + k];
                            min = Math.min(min, other);
                            max = Math.max(max, other);
                        }
                    if (byte < min - 2 || byte > max + 2) {
                        count++;
                        break;
                    }
                }
        return count;
    };
    const context = (width, height) => new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    window.compare = async (canvas, png) => {
        const image = await createImageBitmap(new Blob([bytesOf(png)])), { width, height } = canvas, other = context(width, height);
        if (image.width !== width || image.height !== height)
            return { size: [width, height], wanted: [image.width, image.height] };
        other.fillRect(0, 0, width, height); // for `!offscreen`
        other.drawImage(image, 0, 0);
        const here = canvas.getContext('2d').getImageData(0, 0, width, height).data;
        const there = other.getImageData(0, 0, width, height).data;
        return {
            outside: Math.max(outside(here, there, width, height), outside(there, here, width, height)) / width / height,
            colours: new Set(here).size,
        };
    };
    // Returns the state after some frames.
    window.run = (text, frames) => {
        const reported = [], session = engine.open({ onDiagnostic: ({ rendered }) => reported.push(rendered) });
        session.load(text);
        for (let i = 0; i < frames; i++) {
            session.step();
            session.renderIfNeeded();
        }
        const state = Object.fromEntries(session.state);
        session.close();
        return { reported, state };
    };
    window.draw = async (text, frame, given, png) => {
        const files = Object.fromEntries(Object.entries(given).map(([name, bytes]) => [name, bytesOf(bytes)])), reported = [];
        const images = new Map();
        for (const name of Object.keys(files).filter(file => /\.(png|jpg)$/.test(file)))
            images.set(name, await createImageBitmap(new Blob([files[name]])));
        const image = name => images.get(name.replace('./', ''));
        const session = engine.open({ files, image, onDiagnostic: ({ rendered }) => reported.push(rendered) });
        session.load(text);
        for (let i = 0; i <= frame; i++) {
            session.step();
            session.renderIfNeeded();
        }
        const picture = session.render(), { width, height } = picture.image ?? pictureSize(picture.numbers);
        const canvas = context(width, height);
        const unsupported = picture.image ? picture.unsupported : drawPicture(canvas, picture.numbers, { image });
        if (picture.image)
            canvas.drawImage(picture.image, 0, 0);
        session.close();
        return { reported, unsupported, ...await window.compare(canvas.canvas, png) };
    };
}

function render(script, frame) {
    const png = join(scratch, 'picture.png');
    execFileSync(petri, ['render', script, '--quiet', '--frame', String(frame), '-o', png], { stdio: 'pipe' });
    return readFileSync(png).toString('base64');
}

function judge({ reported = [], unsupported = [], outside, colours, ...sizes }, share) {
    assert.deepEqual([reported, unsupported, sizes], [[], [], {}]);
    assert.ok(outside <= share, `${outside} of the pixels are otherwise`);
    assert.ok(colours > 2, `there are ${colours} bytes only`);
}

async function check(script, frame, share = SHARE, names = []) {
    const files = Object.fromEntries(names.map(name => [name, readFileSync(join(dirname(script), name)).toString('base64')]));
    const text = readFileSync(script, 'utf8');
    judge(await page.evaluate(given => window.draw(...given), [text, frame, files, render(script, frame)]), share);
}

const written = (name, text) => {
    cpSync(join(root, 'tests/pictures/images'), join(scratch, 'images'), { recursive: true });
    writeFileSync(join(scratch, name), text);
    return join(scratch, name);
};

const SPHERE = `!window size=200;150
    !canvas3d viewpoint=0;2;5 focus=0;0;0
        !light direction=-1;-1;-1 color=1
        !sphere size=1 color=1;0.3;0.1
`;

test('the page shows 3-D scenes', options, async () => {
    const script = written('sphere.fl', SPHERE);
    await page.evaluate(() => delete document.body.dataset.frame);
    await page.setInputFiles('#file', script);
    await page.waitForFunction(() => document.body.dataset.frame === '2');
    assert.equal(await page.textContent('#message'), '');
    judge(await page.evaluate(png => window.compare(document.getElementById('picture'), png), render(script, 2)), 0);
});

const SAMPLED = `!window size=60;20
    !canvas id=:pic
        !rect size=60;20 color=0.2;0.4;0.6 fill=true antialias=false
        !rect size=6;2 color=1;0;0 fill=true antialias=false
!counter state=(:points;frame) rate=0 initial=sample(:pic, 0.05;0.95;0.5;0.5;3;3, 7)
!counter state=:mono rate=0 initial=measure_text('petri dish', 'DejaVu Sans Mono', 40)
!counter state=:bold rate=0 initial=measure_text('petri dish', 'DejaVu Sans', 20, :bold)
!counter state=:serif rate=0 initial=measure_text('petri dish', 'DejaVu Serif', 12)
`;

test('in the page, scripts measure texts and sample pictures as with petri render', options, async () => {
    const script = written('sampled.fl', SAMPLED), file = join(scratch, 'sampled.state');
    execFileSync(petri, ['render', script, '--quiet', '--frames', '3', '--state', file, '-o', join(scratch, 'sampled%d.png')]);
    const native = Object.fromEntries([...readFileSync(file, 'utf8').matchAll(/^\$\((.*?)\) = (.*)$/gm)].map(([, key, value]) =>
        [key, value.split(';').map(Number)]));
    const shown = await page.evaluate(text => window.run(text, 3), SAMPLED);
    assert.deepEqual(shown.reported, []);
    for (const [key, value] of Object.entries(native).filter(([key]) => /^:(points|mono|bold|serif)/.test(key))) {
        const share = key.startsWith(':points') ? 1e-6 : 0.01, near = shown.state[key];
        assert.ok(near?.length === value.length && value.every((number, i) => Math.abs(number - near[i]) <= share * Math.abs(number)),
            `${key} is ${near} in the page, ${value} in petri render`);
    }
    assert.equal(native[':points;2'].length, 12);
});

const samples = join(root, 'samples'), pictures = join(root, 'tests/pictures');
for (const name of readdirSync(samples).filter(file => file.endsWith('.fl')))
    test(`the sample ${name} equals that of petri render`, options, () => check(join(samples, name), FRAME, SHARES[name.slice(0, -3)],
        readdirSync(join(samples, 'lib')).map(file => `lib/${file}`).filter(file => file.endsWith('.fl'))));

// All effects, scenes with pictures of other nodes, and trails, as far as they are visible in frame 2.
for (const name of ['adjust', 'bloom', 'blur', 'chromakey', 'edges', 'feedback', 'flare', 'kaleid', 'noise', 'passes', 'shader', 'tonemap',
    'transform', 'vignette'])
    test(`the effect ${name} equals the picture of petri render`, options, () => check(join(pictures, `effect_${name}.fl`), 2, 5e-3));
for (const name of ['dots', 'fields', 'lights', 'metal', 'programs', 'translucency'])
    test(`the scene ${name} equals the picture of petri render`, options, () =>
        check(join(pictures, `scenes/${name}.fl`), 2, 2e-3, name === 'metal' ? ['models/pyramid.obj'] : []));
// All canvas pictures, except those with separate tests, empty ones, HDR canvases, and those with enlarged pixels, with hundreds of lines
// on one spot, with an image file on a linear canvas, whose colours the page does not convert, or with a stroked path without lines, which
// Canvas 2D does not draw.
const OTHERS = new Set(['canvas_wide', 'canvas_wide_blend', 'canvas_wide_paint', 'image_linear', 'path_effects_ends',
    'path_effects', 'gallery', 'window_default', 'window_size', 'canvas_size', 'image_id', 'long_path']);
for (const name of readdirSync(pictures).filter(file => /^(?!effect_).*\.fl$/.test(file)).map(file => file.slice(0, -3))
    .filter(file => !OTHERS.has(file)))
    test(`the picture ${name} equals that of petri render`, options, () =>
        check(join(pictures, `${name}.fl`), 2, SHARES[name] ?? 5e-3, ['images/small.png', 'images/small.jpg']));
test('path effects equal those of petri render, except on text', options, () => check(written('path_effects.fl',
    readFileSync(join(pictures, 'path_effects.fl'), 'utf8').replace(/^.*!text.*\n/m, '')), 2, 5e-3));

// Repeated images, including images of other nodes, with a paint's alpha.
const FADED = `!window size=64;48
    !canvas
        !rect size=64;48 fill=true color=0;0.6;0.2
        !group color=1;1;1;0.35
            !pattern filename='images/small.png'
            !rect point=4;4 size=40;30 fill=true
        !group color=1;1;1;0.6
            !pattern filename='images/small.png' scale=2
            !line points=10;40;58;10 stroke=true stroke_width=8
`;
test('patterns have the alpha of their paint', options, () => check(written('faded.fl', FADED), 2, 5e-3, ['images/small.png']));

// Elliptical gradients on lines and text, patterns on text.
const TURNED = `!window size=120;90
    !canvas font_family='DejaVu Sans' font_size=40
        !gradient radius=40;15 point=60;20 rotate=1/8
            !stop offset=0 color=1;0.2;0.2
            !stop offset=1 color=0.2;0.4;1
        !line points=10;10;110;30 stroke=true stroke_width=12
        !text text='word' point=60;50
        !pattern filename='images/small.png'
        !text text='word' point=60;75
`;
test('paints of text and lines can have another transform', options, () =>
    check(written('turned.fl', TURNED), 2, 5e-3, ['images/small.png']));

test('HDR values above 1 are not supported, which is reported', options, async () => {
    const script = join(pictures, 'canvas_wide.fl');
    const files = { 'images/small.png': readFileSync(join(pictures, 'images/small.png')).toString('base64') };
    const given = [readFileSync(script, 'utf8'), 2, files, render(script, 2)];
    const { unsupported } = await page.evaluate(given => window.draw(...given), given);
    assert.deepEqual(unsupported, ['HDR canvas (colorbits)']);
});

// render.test.mjs: `petri render` of the npm package writes the pictures that the page shows.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { packLink } from '../../src/web/page/link.mjs';
import { atFrame, folder, opened, options, root } from './browser.mjs';

const { findBrowser, outputName, readArguments } = await import(pathToFileURL(join(folder, 'petri/render.mjs')));
const work = fs.mkdtempSync(join(tmpdir(), 'petri-render-'));
after(() => fs.rmSync(work, { recursive: true }));
const browserTest = { ...options, timeout: 180000 };

// Runs the command in `work`. Returns its status and messages.
const render = (args, env = {}) => new Promise(resolve => {
    const words = [join(folder, 'petri/cli.mjs'), 'render', ...args];
    const child = spawn('node', words, { cwd: work, env: { ...process.env, TMPDIR: work, ...env } });
    let errors = '';
    child.stderr.on('data', text => { errors += text; });
    child.on('close', status => resolve({ status, errors }));
});
const bytesOf = name => fs.readFileSync(join(work, name)).toString('base64');

// Returns the number of pixels of the page's picture that differ from those of a PNG file, and the number of different bytes.
const compare = (page, png) => page.evaluate(async base64 => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), c => c.charCodeAt(0))]));
    const shown = document.getElementById('picture'), { width, height } = shown;
    const pixels = source => {
        const context = new OffscreenCanvas(width, height).getContext('2d');
        context.drawImage(source, 0, 0);
        return new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
    };
    const own = pixels(shown), other = pixels(image);
    return { sizes: [image.width - width, image.height - height], differing: own.filter((pixel, i) => pixel !== other[i]).length,
        colours: new Set(own).size };
}, png);

const DISH = `let N=N or 3
!physics state=:p dimensions=2
    for i in ..N
        !particle id=i position=20+30*i;40 radius=8
    !constant force=0;9000
!window size=120;90
    !canvas
        !gradient start=0;0 end=120;90
            !stop offset=0 color=1;0.4;0
            !stop offset=1 color=0;0.6;1
        for i in ..N
            !ellipse point=$(:p;i) radius=8 fill=true
        !image filename='dot.png' point=100;70 size=10;10
        !rect foo=1
`;

test('petri render writes the pictures that the page shows', browserTest, async () => {
    const sample = join(root, 'samples/hello.fl');
    fs.copyFileSync(sample, join(work, 'hello.fl'));
    const { status, errors } = await render(['hello.fl', '-o', 'hello.png', '--frame', '12']);
    assert.deepEqual([status, errors], [0, '']);
    const link = await packLink({ text: fs.readFileSync(sample, 'utf8'), name: 'hello.fl', frame: 12 });
    await opened(link, {
        use: async page => {
            await atFrame(page, 12);
            const { sizes, differing, colours } = await compare(page, bytesOf('hello.png'));
            assert.deepEqual([sizes, differing], [[0, 0], 0]);
            assert.ok(colours > 10);
        },
    });
});

test('petri render writes a series with images of files, numbers as in the native command, and diagnostics', browserTest, async () => {
    fs.copyFileSync(join(root, 'tests/pictures/images/small.png'), join(work, 'dot.png'));
    fs.writeFileSync(join(work, 'dish.fl'), DISH);
    const { status, errors } = await render(['dish.fl', '-o', 'a%03d.png', '--frames', '5', '--every', '2', '-D', 'N=2']);
    assert.equal(status, 0);
    assert.match(errors, /^dish\.fl:14:15: warning: !rect: unknown attribute 'foo' \[unknown-attribute\]\n/);
    // Frames 0 and 1 have no positions; the browser's profile was removed.
    const files = () => fs.readdirSync(work).filter(file => !file.startsWith('hello')).sort();
    assert.deepEqual(files(), ['a002.png', 'a004.png', 'a006.png', 'dish.fl', 'dot.png']);
    assert.ok(bytesOf('a002.png') !== bytesOf('a004.png'));
    const failed = await render(['dish.fl', '-o', 'b.png', '--frames', '1', '-D', 'N=1/']);
    assert.equal(failed.status, 2);
    assert.match(failed.errors, /^dish\.fl:1:5: error: '1\/' is not a number/);
    assert.deepEqual(files().filter(file => file === 'b.png'), []);
});

test('petri render reports that there is no browser, and which output it does not support', async () => {
    fs.writeFileSync(join(work, 'dish.fl'), DISH);
    const none = await render(['dish.fl', '-o', 'c.png'], { CHROME_PATH: 'none' });
    assert.deepEqual(none, { status: 1, errors: 'petri: cannot draw pictures: Chromium, Chrome or Edge is not installed; install one, '
        + 'set CHROME_PATH or use the native petri\n' });
    const other = await render(['dish.fl', '-o', 'c.svg']);
    assert.equal(other.status, 1);
    assert.match(other.errors, /petri for Node\.js draws only PNG files/);
    const broken = await render(['dish.fl', '-o', 'c.png'], { CHROME_PATH: '/bin/false' });
    assert.deepEqual(broken, { status: 1, errors: "petri: cannot draw pictures with '/bin/false': it ended\n" });
});

test('browsers are found in PATH and in the usual places of macOS and Windows', () => {
    const find = (env, platform, ...paths) => findBrowser(env, platform, path => paths.includes(path.replaceAll('\\', '/')));
    assert.equal(find({ PATH: '/a:/b' }, 'linux', '/b/chromium'), '/b/chromium');
    assert.equal(find({ PATH: '/a:/b', CHROME_PATH: '/c' }, 'linux', '/b/chromium', '/c'), '/c');
    assert.equal(find({ PATH: '/a' }, 'linux', '/b/chromium'), null);
    const chrome = '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome';
    assert.equal(find({ PATH: '/a', HOME: '/Users/u' }, 'darwin', chrome), chrome);
    const edge = 'C:/Program Files (x86)/Microsoft/Edge/Application/msedge.exe';
    assert.equal(find({ 'ProgramFiles(x86)': 'C:/Program Files (x86)' }, 'win32', edge), edge);
});

test('arguments and names of files are read as in the native command', () => {
    fs.writeFileSync(join(work, 'dish.fl'), DISH);
    const script = join(work, 'dish.fl');
    assert.equal(readArguments([script, '-o', 'a.png', '--frame=3']).settings.frame, 3);
    for (const args of [[script], [script, '-o', 'a.mp4'], [script, '-o', 'a.png', '--frame', '-1'], ['none.fl', '-o', 'a.png'],
        [script, '-o', '{window}.png'], [script, '-o', 'a.png', '--frames', '0']])
        assert.equal(readArguments(args), null);
    assert.deepEqual(['a.png', 'a%d.png', 'a%3d.png', 'a%05d.png'].map(pattern => outputName(pattern, 12)),
        ['a.png', 'a12.png', 'a 12.png', 'a00012.png']);
});

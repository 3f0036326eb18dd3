// vscode.test.mjs: the packed extension for VS Code with a substitute for VS Code (tests/editors/fake_vscode): the bundled language server,
// and the preview in Chromium.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { folder as web, options as browserOptions, pixels, root, says, visited } from './browser.mjs';

const source = join(root, 'src/editors/vscode');
const isThere = fs.existsSync(join(source, 'node_modules/.bin/vsce')) && fs.existsSync(join(web, 'petri/petri-command.wasm'));
const options = { ...browserOptions, skip: browserOptions.skip || (isThere ? false : 'vsce is not installed (./dev package --vscode)') };
const work = fs.realpathSync(fs.mkdtempSync(join(tmpdir(), 'petri-vscode-')));
const unpacked = join(work, 'extension');
const TYPES = { '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.html': 'text/html' };
const coloured = (colour, more = '') => `${more}!counter state=:c rate=1\n!window size=64;32\n    !canvas\n`
    + `        !rect size=64;32 color=${colour} fill=true\n`;
const realPath = process.env.PATH;
let vscode, seen, extension, files, pages, html;

// Returns the origin of a new server.
function serve(answer) {
    const server = createServer(answer);
    return new Promise(resolve => server.listen(0, '127.0.0.1', () =>
        resolve({ server, origin: `http://127.0.0.1:${server.address().port}` })));
}

before(async () => {
    if (options.skip)
        return;
    const done = (command, ...args) => {
        const { status, stdout, stderr } = spawnSync(command, args, { cwd: source, encoding: 'utf8' });
        assert.equal(status, 0, stdout + stderr);
    };
    fs.writeFileSync(join(work, 'grammar.json'), '{}');
    done('npm', 'run', 'bundle');
    done(join(source, 'package.py'), join(work, 'grammar.json'), join(web, 'petri'), join(work, 'petri.vsix'));
    done('python3', '-m', 'zipfile', '-e', join(work, 'petri.vsix'), work);
    fs.mkdirSync(join(work, 'node_modules'));
    fs.symlinkSync(join(root, 'tests/editors/fake_vscode'), join(work, 'node_modules/vscode'));
    // Webviews load the extension's files from another origin.
    files = await serve((request, response) => {
        const path = request.url, known = path.startsWith(`${unpacked}/dist/`) || path.startsWith(`${unpacked}/engine/`);
        response.writeHead(known ? 200 : 404, { 'Access-Control-Allow-Origin': '*', 'Content-Type': TYPES[extname(path)] ?? 'text/plain' });
        response.end(known ? fs.readFileSync(path) : '');
    });
    pages = await serve((request, response) => response.writeHead(200, { 'Content-Type': TYPES['.html'] })
        .end(request.url === '/' ? html : ''));
    const require = createRequire(join(unpacked, 'package.json'));
    vscode = require('vscode');
    ({ seen } = vscode);
    seen.origin = files.origin;
    process.env.PATH = ''; // petri is not found
    extension = require('./dist/extension.js');
    await extension.activate({ subscriptions: [], extensionPath: unpacked, extensionUri: vscode.Uri.file(unpacked) });
});

after(async () => {
    process.env.PATH = realPath;
    await extension?.deactivate();
    files?.server.close();
    pages?.server.close();
    fs.rmSync(work, { recursive: true });
});

// Opens a document in the substitute, as the active editor.
function opened(name, text) {
    const fileName = join(work, 'scripts', name);
    fs.mkdirSync(join(work, 'scripts'), { recursive: true });
    fs.writeFileSync(fileName, text);
    const document = {
        fileName, uri: vscode.Uri.file(fileName), languageId: 'flitter', version: 1, isDirty: false, text, getText: () => document.text,
        save: async () => true,
    };
    vscode.workspace.textDocuments.push(document);
    vscode.window.activeTextEditor = { document };
    seen.opened.fire(document);
    return document;
}

function changed(document, text) {
    const all = { range: new vscode.Range(0, 0, document.text.split('\n').length, 0), rangeOffset: 0, rangeLength: document.text.length };
    document.text = text;
    document.version++;
    seen.changed.fire({ document, contentChanges: [{ ...all, text }] });
}

async function until(found) {
    for (let i = 0; i < 3000; i++) {
        const value = found();
        if (value)
            return value;
        await new Promise(resolve => setTimeout(resolve, 10));
    }
    throw new Error(`never true: ${found}`);
}

// A program that acts as the installed petri.
function installed(name, shell) {
    const path = join(work, name);
    fs.writeFileSync(path, `#!/bin/sh\n${shell}\n`, { mode: 0o755 });
    return path;
}

test('without petri, the bundled server reports errors', options, async () => {
    const [status] = seen.statuses, { version } = createRequire(join(unpacked, 'package.json'))('./package.json');
    assert.deepEqual([status.text, status.detail], [`petri ${version} in WebAssembly`, "bundled, because 'petri' was not found"]);
    const document = opened('error.fl', 'let a=coz(1)\n');
    const [problem] = await until(() => seen.diagnostics[document.uri]?.length && seen.diagnostics[document.uri]);
    assert.match(problem.message, /unbound name 'coz'/);
    changed(document, 'let a=cos(1)\n');
    await until(() => seen.diagnostics[document.uri].length === 0);
    assert.deepEqual(seen.messages, []);
});

test('without petri, a script runs in a terminal', options, async () => {
    opened('run.fl', '!a b=7\n');
    await seen.commands['petri.run']();
    const { process: program, args, options: { cwd, env } } = seen.tasks.pop().execution;
    const settings = { cwd, env: { ...process.env, ...env }, encoding: 'utf8' };
    const ran = spawnSync(program, [...args, '--frames', '1', '--print', 'tree'], settings);
    assert.equal(ran.status, 0, ran.stderr);
    assert.match(ran.stdout, /!a b=7/);
});

test('code lenses run, render and test a script that need not be the active one', options, async () => {
    const { fileName, uri } = opened('lens.fl', '!window size=3;2\n    !canvas\n');
    opened('active.fl', '!a b=7\n');
    const pictures = [];
    seen.commands['vscode.open'] = picture => pictures.push(picture.fsPath);
    for (const [name, more] of [['run', []], ['test', []], ['render', ['-o', fileName.replace('.fl', '.png')]]]) {
        await seen.commands[`petri.${name}`](uri.toString());
        assert.deepEqual(seen.tasks[0].execution.args.slice(-2 - more.length), [name, fileName, ...more]);
        const task = seen.tasks.pop();
        seen.ended.fire({ execution: { task: { name: 'another' } }, exitCode: 0 });
        seen.ended.fire({ execution: { task }, exitCode: name === 'render' ? 0 : 1 });
        seen.ended.fire({ execution: { task }, exitCode: 0 });
    }
    assert.deepEqual(pictures, [fileName.replace('.fl', '.png')]);
});

test('without petri, the window is refused and the preview offered', options, async () => {
    opened('view.fl', '!a b=7\n');
    seen.answer = 'Show Preview';
    await seen.commands['petri.view']();
    assert.equal(seen.messages.pop(), "The window needs petri to be installed, but 'petri' was not found.");
    assert.equal(seen.tasks.length, 0);
    assert.equal(seen.panels.length, 1);
    seen.panels.pop().disposed.fire();
    seen.answer = undefined;
});

// In another process, because the client library leaves rejected promises when a start fails.
test('a restart recovers from a failed start', options, () => {
    const code = `const load = require('module').createRequire('${unpacked}/package.json'), { seen, Uri } = load('vscode');
        seen.settings.path = '${installed('broken', '[ "$2" = --help ] || exit 1')}';
        const show = () => console.log(seen.statuses[0].text, '/', seen.messages.at(-1));
        (async () => {
            const context = { subscriptions: [], extensionPath: '${unpacked}', extensionUri: Uri.file('${unpacked}') };
            await load('./dist/extension.js').activate(context);
            show();
            seen.settings.path = 'none';
            seen.messages.length = 0;
            await seen.commands['petri.restart']();
            show();
            process.exit();
        })();`;
    const settings = { encoding: 'utf8', timeout: 50000 };
    const { stdout, stderr } = spawnSync(process.execPath, ['--unhandled-rejections=warn', '-e', code], settings);
    const [failed, recovered] = stdout.trim().split('\n');
    assert.match(failed, /^petri: no server \/ Cannot start .*broken: .*petri\.path/, stdout + stderr);
    assert.match(recovered, /^petri [\d.]+ in WebAssembly \/ /);
});

test('the installed server is used if there is one', options, async () => {
    const [status] = seen.statuses, affectsConfiguration = name => name === 'petri';
    seen.settings.path = installed('petri', `exec '${process.execPath}' '${join(web, 'petri/cli.mjs')}' "$@"`);
    await seen.commands['petri.restart']();
    assert.equal(status.detail, seen.settings.path);
    assert.match(status.text, /^petri [\d.]+$/);
    const { fileName } = opened('window.fl', '!a b=7\n');
    await seen.commands['petri.view']();
    const { process: program, args } = seen.tasks.pop().execution;
    assert.deepEqual([program, ...args.slice(0, 3)], [seen.settings.path, 'view', fileName, '--listen']);
    seen.settings.path = installed('old', 'exit 1');
    seen.configured.fire({ affectsConfiguration });
    await until(() => status.detail === `bundled, because ${seen.settings.path} has no language server`);
    seen.settings.path = 'petri';
    seen.messages.length = 0;
});

// Opens the preview of a script in Chromium, as VS Code's webview does.
async function previewed(document, use, { command = 'petri.preview', ...settings } = {}) {
    vscode.window.activeTextEditor = { document };
    await seen.commands[command]();
    const panel = seen.panels.at(-1);
    ({ html } = panel.webview);
    const closed = () => {
        panel.onSend = null;
        panel.disposed.fire();
    };
    await visited(`${pages.origin}/`, {
        settings: { reducedMotion: 'no-preference', viewport: { width: 500, height: 640 }, ...settings },
        prepare: async page => {
            await page.exposeFunction('toExtension', message => panel.received.fire(message));
            await page.addInitScript('globalThis.acquireVsCodeApi = () => ({ postMessage: message => toExtension(message) })');
            panel.onSend = message => page.evaluate(({ sent, bytes }) => {
                const given = Object.fromEntries(bytes.map(([name, values]) => [name, new Uint8Array(values)]));
                postMessage({ ...sent, files: given });
            }, { sent: { ...message, files: null }, bytes: Object.entries(message.files).map(([name, value]) => [name, [...value]]) });
        },
        ready: () => document.body.dataset.frame,
        use: page => use(page, panel),
    }).finally(closed);
}

const hasColour = (page, wanted) => page.waitForFunction(text => {
    const { data } = document.getElementById('picture').getContext('2d').getImageData(30, 10, 1, 1);
    return [...data].slice(0, 3).join(';') === text;
}, wanted);
const frameOf = page => page.evaluate(() => Number(document.body.dataset.frame));
const passes = (page, frame) => page.waitForFunction(min => Number(document.body.dataset.frame) > min, frame);
const isRunning = page => page.evaluate(() => document.getElementById('run').textContent === 'Pause');

test('the preview loads only files of the extension, and only its own script', options, () => previewed(opened('a.fl', coloured('1;0;0')),
    async (page, { options: { enableScripts, localResourceRoots }, place }) => {
        assert.ok(enableScripts && place.viewColumn === vscode.ViewColumn.Beside);
        assert.deepEqual(localResourceRoots.map(({ fsPath }) => fsPath), [join(unpacked, 'dist'), join(unpacked, 'engine')]);
        const policy = /Content-Security-Policy" content="([^"]*)"/.exec(html)[1], [, nonce] = /<script nonce="(\w{32})"/.exec(html);
        assert.equal(policy, `default-src 'none'; script-src 'nonce-${nonce}' 'wasm-unsafe-eval'; style-src ${files.origin}; `
            + `connect-src ${files.origin}; worker-src blob:; img-src blob: data:`);
        await passes(page, 5);
    }));

test('an edit in the editor changes the running preview, with its state', options, async () => {
    const document = opened('dish.fl', coloured('1;0;0'));
    await previewed(document, async (page, panel) => {
        assert.equal(panel.title, 'Preview dish.fl');
        await hasColour(page, '255;0;0');
        await passes(page, 30);
        await page.evaluate(() => {
            globalThis.frames = [];
            new MutationObserver(() => globalThis.frames.push(Number(document.body.dataset.frame)))
                .observe(document.body, { attributes: true, attributeFilter: ['data-frame'] });
        });
        changed(document, coloured('0;1;0'));
        await hasColour(page, '0;255;0');
        assert.ok(await isRunning(page));
        const frames = await page.evaluate(() => globalThis.frames);
        changed(opened('dish.fl', coloured('0;1;0')), coloured('0;0;1')); // closed and opened again
        await hasColour(page, '0;0;255');
        assert.ok(frames[0] > 30 && frames.every((frame, i) => i === 0 || frame >= frames[i - 1]), `${frames}`);
    });
});

test('the preview reports an error, keeps the last version, and goes to the line', options, async () => {
    const document = opened('error.fl', coloured('1;0;0'));
    await previewed(document, async page => {
        await hasColour(page, '255;0;0');
        changed(document, coloured('1;0;0', '!a b=1\n!a x=1)\n'));
        await says(page, /^1 error: the last version without errors is running\.$/);
        await passes(page, await frameOf(page) + 5);
        assert.match(await page.textContent('#problems'), /^2:7: error/);
        const { y, height } = await page.locator('#problems button').first().boundingBox();
        assert.ok(y + height < 640, 'the error is visible without scrolling');
        await page.click('#problems button');
        const { selection, document: shown } = await until(() => seen.shown.find(editor => editor.selection));
        assert.deepEqual([shown, selection.start.line, selection.start.character], [document, 1, 6]);
        changed(document, coloured('0;0;1'));
        await hasColour(page, '0;0;255');
        assert.deepEqual([await page.textContent('#message'), await page.textContent('#problems')], ['', '']);
    });
});

test('a click on a particle leads to the lines that make it and that move it', options, async () => {
    const { fileName: module } = opened('drop.fl', 'func drop(i)\n    !particle id=i radius=40 position=0;0\n');
    const document = opened('pick.fl',
        "import drop from 'drop.fl'\n!physics state=:p dimensions=2\n    drop(7)\n    !constant force=0;1\n");
    await previewed(document, async (page, panel) => {
        assert.ok(await page.isHidden('#particle'));
        const { x, y, width, height } = await page.locator('#picture').boundingBox();
        await page.mouse.click(x + width / 2, y + height / 2);
        await page.waitForFunction(() => document.getElementById('particle-title').textContent.startsWith(':p;7 in frame '));
        const before = await page.textContent('#particle-title');
        await page.waitForFunction(text => document.getElementById('particle-title').textContent !== text, before); // follows the frames
        assert.match(await page.textContent('#particle'), /made by line 2.*constant.*0;1.*pick\.fl:4.*sum/s);
        for (const [button, file, line] of [['#particle-forces button', document.fileName, 3], ['#particle-origin button', module, 1]]) {
            seen.shown.length = 0;
            await page.click(button);
            const { selection, document: shown } = await until(() => seen.shown.find(editor => editor.selection));
            assert.deepEqual([shown.fileName ?? shown.fsPath, selection.start.line], [file, line]);
        }
        seen.shown.length = 0;
        panel.received.fire({ type: 'goTo', file: '../../etc/passwd', line: 1, column: 1 });
        assert.equal((await until(() => seen.shown[0])).document, document);
        await seen.commands['petri.preview'](); // the same script
        assert.ok(await page.isVisible('#particle'));
        vscode.window.activeTextEditor = { document: opened('other.fl', coloured('1;0;0')) };
        await seen.commands['petri.preview']();
        await hasColour(page, '255;0;0');
        assert.ok(await page.isHidden('#particle'));
    });
});

test('the preview of a script with an error starts when the error is corrected', options, async () => {
    const document = opened('broken.fl', '!window size=(1;2\n'), panels = seen.panels.length;
    seen.commands['petri.preview']();
    const panel = seen.panels.at(-1);
    assert.equal(seen.panels.length, panels + 1);
    panel.disposed.fire();
    document.text = coloured('1;0;0');
    await previewed(document, async page => {
        changed(document, '!window size=(1;2\n');
        await says(page, /^1 error/);
        changed(document, coloured('0;1;0'));
        await hasColour(page, '0;255;0');
        await passes(page, await frameOf(page) + 3);
    });
});

test('the preview reads modules in the folder of the script, also unsaved ones', options, async () => {
    const module = opened('lib.fl', 'let COLOUR=1;0;0\n');
    const document = opened('main.fl', coloured('COLOUR', "import COLOUR from 'lib.fl'\n"));
    await previewed(document, async page => {
        await hasColour(page, '255;0;0');
        await passes(page, 20);
        changed(module, 'let COLOUR=0;0;1\n');
        await hasColour(page, '0;0;255');
        assert.ok(await frameOf(page) > 20);
    });
});

test('another script replaces the picture, and starts at its first frame', options, async () => {
    const first = opened('first.fl', coloured('1;0;0')), second = opened('second.fl', coloured('0;1;0'));
    await previewed(first, async (page, panel) => {
        await passes(page, 60);
        vscode.window.activeTextEditor = { document: second };
        seen.commands['petri.preview']();
        await hasColour(page, '0;255;0');
        assert.deepEqual([seen.panels.at(-1), panel.title, panel.revealed], [panel, 'Preview second.fl', 1]);
        assert.ok(await frameOf(page) < 60);
        assert.equal((await pixels(page)).width, 64);
    });
});

test('the sample of the walkthrough opens with its preview, unsaved', options, () => previewed(undefined, async (page, panel) => {
    const { document } = seen.shown.at(-1);
    assert.deepEqual([panel.title, document.languageId, document.isDirty], ['Preview Untitled-1', 'flitter', true]);
    assert.equal(document.text, fs.readFileSync(join(root, 'samples/dish.fl'), 'utf8'));
    await passes(page, 5);
    assert.deepEqual([await page.textContent('#message'), await page.textContent('#problems')], ['', '']);
    assert.ok((await pixels(page)).all > 100);
}, { command: 'petri.sample' }));

test('the extension contains the licences of the C code in its engine', options, () => {
    const text = fs.readFileSync(join(unpacked, 'engine/third-party-licences.txt'), 'utf8');
    assert.match(text, /^xxHash$/m);
    assert.match(text, /^musl/m);
    assert.ok(fs.statSync(join(work, 'petri.vsix')).size < 2e6);
});

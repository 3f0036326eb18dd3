// render.mjs: `petri render` in Node.js: a headless browser draws the pictures in a page of this package (render_page.mjs), which sends
// them back.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { filesBelow } from './files.mjs';
import { startServer } from './local_server.mjs';

const PACKAGE = dirname(fileURLToPath(import.meta.url));
const INDEX = '<!DOCTYPE html><title>petri</title><script type="module" src="render_page.mjs"></script>\n';
const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'msedge', 'microsoft-edge', 'chrome'];
const MAC_NAMES = ['Google Chrome', 'Chromium', 'Microsoft Edge'];
const WINDOWS_NAMES = ['Google/Chrome/Application/chrome.exe', 'Chromium/Application/chrome.exe', 'Microsoft/Edge/Application/msedge.exe'];
const IMAGE = /\.(png|jpe?g|gif|webp)$/i;
const START_MS = 60000; // time within which the page must ask for its files
const END_MS = 10000; // time within which the browser must end

// Returns the path of a Chromium browser, or null. CHROME_PATH has precedence.
export function findBrowser(env = process.env, platform = process.platform, exists = fs.existsSync) {
    if (env.CHROME_PATH)
        return exists(env.CHROME_PATH) ? env.CHROME_PATH : null;
    const suffix = platform === 'win32' ? '.exe' : '';
    const places = (env.PATH ?? env.Path ?? '').split(delimiter).filter(Boolean)
        .flatMap(folder => NAMES.map(name => join(folder, name + suffix)));
    if (platform === 'darwin')
        places.push(...['/Applications', join(env.HOME ?? '/', 'Applications')].flatMap(folder =>
            MAC_NAMES.map(name => `${folder}/${name}.app/Contents/MacOS/${name}`)));
    if (platform === 'win32')
        places.push(...[env.ProgramFiles, env['ProgramFiles(x86)'], env.LOCALAPPDATA].filter(Boolean).flatMap(folder =>
            WINDOWS_NAMES.map(name => join(folder, name))));
    return places.find(exists) ?? null;
}

function remove(folder) {
    try {
        fs.rmSync(folder, { recursive: true, force: true });
        return true;
    } catch {
        return false;
    }
}

// Starts the browser. Returns { ended, end }: a promise that resolves when it has ended, and a function that ends it and removes its files.
function startBrowser(path, url) {
    const profile = fs.mkdtempSync(join(tmpdir(), 'petri-browser-'));
    // The browser ends when the pipes for debugging are closed, also if this process is killed. Root cannot use the browser's sandbox.
    const child = spawn(path, ['--headless', `--user-data-dir=${profile}`, '--remote-debugging-pipe', '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
        '--disable-sync', ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []), url], {
        stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'],
    });
    const ended = new Promise(resolve => child.on('error', resolve).on('close', () => resolve(new Error('it ended'))));
    child.stdio[3].on('error', () => {});
    child.stdio[4].on('error', () => {}).resume();
    const end = async () => {
        child.stdio[3].end('{"id":1,"method":"Browser.close"}\0');
        const timer = setTimeout(() => child.kill('SIGKILL'), END_MS);
        await ended;
        clearTimeout(timer);
        // The browser's other processes may still write files.
        for (let i = 0; i < 50 && !remove(profile); i++)
            await new Promise(resolve => setTimeout(resolve, 100));
    };
    return { ended, end };
}

// Returns the name of the file for a frame: `%d` and `%05d` become its number.
export const outputName = (pattern, frame) => pattern.replace(/%(0?)(\d?)d/, (match, zero, width) =>
    String(frame).padStart(Number(width), zero ? '0' : ' '));

// Reads the arguments of `petri render`. Returns the script, the output and the settings for the page, or null if this file does not
// support them. The program, which then runs, reports the reason.
export function readArguments(args) {
    const option = { type: 'string' };
    let values, positionals;
    try {
        ({ values, positionals } = parseArgs({
            args, allowPositionals: true,
            options: {
                output: { type: 'string', short: 'o' }, frame: option, frames: option, every: option, fps: option, threads: option,
                define: { type: 'string', short: 'D', multiple: true }, auto: { type: 'boolean' }, quiet: { type: 'boolean' },
                lockstep: { type: 'boolean' },
            },
        }));
    } catch {
        return null;
    }
    const { output = '', define = [], auto = false, quiet = false } = values, [script] = positionals;
    const count = (text, min) => (text === undefined || (/^\d{1,9}$/.test(text) && Number(text) >= min));
    if (positionals.length !== 1 || !/\.png$/i.test(output) || output.includes('{window}') || !script.endsWith('.fl')
        || !fs.statSync(script, { throwIfNoEntry: false })?.isFile()
        || !count(values.frame, 0) || !count(values.frames, 1) || !count(values.every, 1) || !count(values.threads, 1)
        || !(values.fps === undefined || (/^\d+(\.\d+)?$/.test(values.fps) && Number(values.fps) > 0)))
        return null;
    const number = (text, usual) => (text === undefined ? usual : Number(text));
    return {
        script, output,
        settings: {
            define, quiet, automatic: auto, frame: number(values.frame, null), frames: number(values.frames, 600),
            every: number(values.every, 1), fps: number(values.fps, 0), series: outputName(output, 0) !== output,
        },
    };
}

// Returns the settings for the page, with the script and the files that it can read, and the images, which the page fetches.
function readScript({ script, settings }) {
    const name = process.platform === 'win32' ? script.replaceAll('\\', '/') : script;
    const folder = dirname(fs.realpathSync(script)), prefix = name.slice(0, name.lastIndexOf('/') + 1);
    const below = read => Object.fromEntries(Object.entries(filesBelow(folder, read))
        .map(([file, value]) => [prefix + file, value]));
    const images = below((bytes, file) => (IMAGE.test(file) ? bytes : null));
    const job = { ...settings, text: fs.readFileSync(script, 'utf8'), name, files: below(), imageNames: Object.keys(images) };
    return { job: JSON.stringify(job), images: Object.values(images) };
}

// Serves the page and receives its pictures and messages. Returns { url, close, started, done }; `done` resolves to the exit status.
async function servePage({ job, images }, output, message) {
    const modules = fs.readdirSync(PACKAGE).filter(file => /(\.mjs|^engine(-scalar)?\.wasm)$/.test(file));
    const page = {};
    page.done = new Promise(resolve => { page.finish = resolve; });
    page.started = new Promise(resolve => { page.start = resolve; });
    const contents = file => {
        page.start();
        return file === 'index.html' ? INDEX : file === 'job.json' ? job
            : file.startsWith('image/') ? images[file.slice('image/'.length)] ?? null
                : modules.includes(file) ? fs.readFileSync(join(PACKAGE, file)) : null;
    };
    const receive = (file, body) => {
        if (file === 'messages')
            process.stderr.write(body);
        else if (/^ended\/[012]$/.test(file))
            page.finish(Number(file.slice('ended/'.length)));
        else if (/^picture\/\d+$/.test(file))
            fs.writeFileSync(outputName(output, file.slice('picture/'.length)), body);
    };
    const { url, close } = await startServer(contents, (file, request, response) => {
        if (request.method !== 'POST')
            return false;
        const parts = [];
        request.on('data', part => parts.push(part)).on('end', () => {
            try {
                receive(file, Buffer.concat(parts));
                response.writeHead(204).end();
            } catch (error) {
                message(`cannot write '${output}': ${error.message}`);
                response.writeHead(500).end();
                page.finish(1);
            }
        });
        return true;
    });
    return { ...page, url, close };
}

// Runs `petri render` with its arguments. Returns the exit status, or null if the program must run instead.
export async function render(args) {
    const message = text => process.stderr.write(`petri: ${text}\n`);
    const request = readArguments(args);
    if (!request)
        return null;
    const path = findBrowser();
    if (!path) {
        message('cannot draw pictures: Chromium, Chrome or Edge is not installed; install one, set CHROME_PATH or use the native petri');
        return 1;
    }
    const page = await servePage(readScript(request), request.output, message);
    const browser = startBrowser(path, page.url);
    const end = async () => {
        await browser.end();
        page.close();
    };
    for (const [name, number] of [['SIGINT', 2], ['SIGTERM', 15], ['SIGHUP', 1]])
        process.on(name, () => end().then(() => process.exit(128 + number)));
    const late = new Promise(resolve => setTimeout(resolve, START_MS, new Error('it does not respond')).unref());
    const result = await Promise.race([page.started, browser.ended, late]) ?? await Promise.race([page.done, browser.ended]);
    await end();
    if (!(result instanceof Error))
        return result;
    message(`cannot draw pictures with '${path}': ${result.message}`);
    return 1;
}

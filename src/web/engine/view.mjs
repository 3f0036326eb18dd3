// view.mjs: `petri view SCRIPT.fl` in Node.js: serves the page from the package, shows the script there and reloads it when it changes.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { filesBelow } from './files.mjs';
import { HEADERS, startServer } from './local_server.mjs';

const PACKAGE = dirname(fileURLToPath(import.meta.url));
const MAX_LINK = 100000;
const POLL_MS = 200;

// Returns the link of the page to a script.
export function linkTo(text, name) {
    const link = `#${deflateRawSync(JSON.stringify({ v: 1, t: text, n: name, c: [] }), { level: 9 }).toString('base64url')}`;
    if (link.length > MAX_LINK)
        throw new Error(`the script is too long for the page: ${link.length} characters when compressed, at most ${MAX_LINK}`);
    return link;
}

// Serves the page for a script. Returns { url, close }. `report` receives messages about later changes.
export async function serveScript(script, report = () => {}) {
    const name = basename(script), pages = new Set();
    const read = () => linkTo(fs.readFileSync(script, 'utf8'), name);
    let link = read();
    const page = fs.readdirSync(join(PACKAGE, 'page'));
    const contents = file => {
        if (file === 'index.html')
            return fs.readFileSync(join(PACKAGE, 'page/index.html'), 'utf8').replace('<script', '<script src="view.js"></script>\n<script')
                .replaceAll(/<a href="(manual|tour)[^]*?<\/a>/g, '');
        if (file === 'view.js')
            return `globalThis.petriView = true;\nhistory.replaceState(null, '', ${JSON.stringify(link)});\n`
                + 'new EventSource("events").onmessage = event => { location.hash = event.data; };\n';
        if (file === 'samples.json') {
            const given = JSON.parse(fs.readFileSync(join(PACKAGE, 'page/samples.json'), 'utf8'));
            return JSON.stringify({ ...given, pictures: {}, files: { ...given.files, ...filesBelow(dirname(fs.realpathSync(script))) } });
        }
        return /^petri\/engine(-archives|-scalar)?\.wasm$/.test(file) ? fs.readFileSync(join(PACKAGE, basename(file)))
            : page.includes(file) && file !== 'offline.js' ? fs.readFileSync(join(PACKAGE, 'page', file)) : null;
    };
    const server = await startServer(contents, (file, request, response) => {
        if (file !== 'events')
            return false;
        response.writeHead(200, { ...HEADERS, 'Content-Type': 'text/event-stream' }).flushHeaders();
        pages.add(response);
        response.on('close', () => pages.delete(response));
        return true;
    });
    const update = () => {
        try {
            const next = read();
            if (next !== link)
                for (const response of pages)
                    response.write(`data: ${next}\n\n`);
            link = next;
        } catch (error) {
            report(`cannot reload '${script}': ${error.message}`);
        }
    };
    fs.watchFile(script, { interval: POLL_MS }, update);
    const close = () => {
        fs.unwatchFile(script, update);
        server.close();
    };
    return { url: server.url, close };
}

// Opens a URL in the browser if there is one.
function openBrowser(url) {
    const command = process.platform === 'win32' ? ['rundll32', 'url.dll,FileProtocolHandler'] : process.platform === 'darwin' ? ['open']
        : process.env.BROWSER ? [process.env.BROWSER] : process.env.DISPLAY || process.env.WAYLAND_DISPLAY ? ['xdg-open'] : null;
    if (command)
        spawn(command[0], [...command.slice(1), url], { stdio: 'ignore', detached: true }).on('error', () => {}).unref();
}

// Runs `petri view` with its arguments. Returns the exit status if it fails.
export async function view(args) {
    const message = text => console.error(`petri: ${text}`);
    const option = args.find(word => word.startsWith('-'));
    if (option || args.length !== 1) {
        message(option ? `petri view in Node.js has no option '${option}'; it takes a script only`
            : 'petri view in Node.js takes one script');
        return 2;
    }
    if (!fs.existsSync(join(PACKAGE, 'page'))) {
        message('cannot show pictures: this package was built without the page');
        return 1;
    }
    try {
        const { url } = await serveScript(args[0], message);
        console.log(`petri shows ${args[0]} at ${url}; press Ctrl-C to stop`);
        openBrowser(url);
    } catch (error) {
        message(error.code === 'ENOENT' ? `cannot read '${args[0]}': No such file or directory` : error.message);
        return 1;
    }
    return null;
}

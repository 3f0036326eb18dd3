// serve.mjs FOLDER [PORT]: serves a folder on 127.0.0.1. Port 0, the default: any free port.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const TYPES = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
    '.json': 'application/json', '.wasm': 'application/wasm' };

// The page runs untrusted scripts, so it must not exchange data with other sites.
const HEADERS = {
    'Content-Security-Policy': "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
        + "img-src 'self' data: blob:; connect-src 'self'; object-src 'none'; base-uri 'none'",
    // The stop button needs shared memory, which browsers allow only on cross-origin isolated pages.
    'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp',
    // Allow <petri-dish> in pages of other sites.
    'Cross-Origin-Resource-Policy': 'cross-origin', 'Access-Control-Allow-Origin': '*',
    'X-Content-Type-Options': 'nosniff', 'Cache-Control': 'no-cache',
};

// Returns the file for a request, or null if there is none. Throws an error if the URL is invalid.
function requestedFile(folder, url) {
    const path = normalize(decodeURIComponent(new URL(url, 'http://x').pathname));
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    return statSync(file, { throwIfNoEntry: false })?.isFile() ? file : null;
}

export function serve(folder, port = 0) {
    const server = createServer((request, response) => {
        const refuse = (status, text) => response.writeHead(status, { 'Content-Type': 'text/plain' }).end(text);
        let file;
        try {
            file = requestedFile(folder, request.url);
        } catch { // an invalid %-sequence, host or NUL, or a name that is too long for the file system
            refuse(400, 'bad request\n');
            return;
        }
        if (!file) {
            refuse(404, 'no such file\n');
            return;
        }
        response.writeHead(200, { ...HEADERS, 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' });
        createReadStream(file).on('error', () => response.destroy()).pipe(response);
    });
    return new Promise(resolve => server.listen(port, '127.0.0.1', () =>
        resolve({ url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() })));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const { url } = await serve(process.argv[2], Number(process.argv[3] ?? 0));
    console.log(`petri is at ${url}; press Ctrl-C to stop the server`);
}

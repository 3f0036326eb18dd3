// local_server.mjs: an HTTP server for the pages of `petri view` and `petri render`. It listens on 127.0.0.1, and its URLs begin with a
// random token, so that other users and other pages cannot read the script.
import { randomBytes } from 'node:crypto';
import { createServer } from 'node:http';
import { extname } from 'node:path';

const TYPES = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
    '.json': 'application/json', '.wasm': 'application/wasm',
    '.svg': 'image/svg+xml', '.webmanifest': 'application/manifest+json' };
// The page runs untrusted scripts, so it must not exchange data with other sites. The stop button needs shared memory, which browsers allow
// only on cross-origin isolated pages.
export const ISOLATION = {
    'Content-Security-Policy': "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
        + "img-src 'self' data: blob:; connect-src 'self'; object-src 'none'; base-uri 'none'",
    'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp',
    'X-Content-Type-Options': 'nosniff',
};
export const HEADERS = { ...ISOLATION, 'Referrer-Policy': 'no-referrer', 'Cache-Control': 'no-store' };

// Starts a server. `contents(file)` returns the content of a file, or null if there is none. `answer(file, request, response)` returns true
// if it answers the request itself. Returns { url, close }.
export function startServer(contents, answer) {
    const prefix = `/${randomBytes(16).toString('hex')}/`;
    const server = createServer((request, response) => {
        const path = request.url.split(/[?#]/)[0], file = path === prefix ? 'index.html' : path.slice(prefix.length);
        if (!path.startsWith(prefix) || request.headers.host !== `127.0.0.1:${server.address().port}`) {
            response.writeHead(404, HEADERS).end();
        } else if (!answer(file, request, response)) {
            const content = contents(file);
            const type = TYPES[extname(file)] ?? 'text/plain';
            response.writeHead(content === null ? 404 : 200, { ...HEADERS, 'Content-Type': type }).end(content);
        }
    });
    const close = () => {
        server.close();
        server.closeAllConnections?.();
    };
    return new Promise((resolve, reject) => server.on('error', reject).listen(0, '127.0.0.1', () =>
        resolve({ url: `http://127.0.0.1:${server.address().port}${prefix}`, close })));
}

// serve.mjs FOLDER [PORT]: serves a folder on 127.0.0.1; port 0, the default, is any that is free.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const TYPES = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
    '.json': 'application/json', '.wasm': 'application/wasm' };

// The page runs scripts of strangers: it gets nothing from elsewhere and sends nothing there.
const HEADERS = {
    'Content-Security-Policy': "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
        + "img-src 'self' data: blob:; connect-src 'self'; object-src 'none'; base-uri 'none'",
    // The stop button's flag is memory that threads share, which browsers give to pages that nobody else can look into.
    'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp',
    // <petri-dish> works in pages from elsewhere.
    'Cross-Origin-Resource-Policy': 'cross-origin', 'Access-Control-Allow-Origin': '*',
    'X-Content-Type-Options': 'nosniff', 'Cache-Control': 'no-cache',
};

export function serve(folder, port = 0) {
    const server = createServer((request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
        const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
        if (!statSync(file, { throwIfNoEntry: false })?.isFile()) {
            response.writeHead(404, { 'Content-Type': 'text/plain' }).end('there is no such file\n');
            return;
        }
        response.writeHead(200, { ...HEADERS, 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' });
        createReadStream(file).pipe(response);
    });
    return new Promise(resolve => server.listen(port, '127.0.0.1', () =>
        resolve({ url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() })));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const { url } = await serve(process.argv[2], Number(process.argv[3] ?? 0));
    console.log(`petri is at ${url}; Ctrl-C ends it`);
}

// serve.mjs FOLDER [PORT]: serves a folder on 127.0.0.1. Port 0, the default: any free port.
import { statSync } from 'node:fs';
import { createServer } from 'node:http';
import { join, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import sirv from 'sirv';
import { ISOLATION } from '../engine/local_server.mjs';

// Allows <petri-dish> in pages of other sites.
const HEADERS = { ...ISOLATION, 'Cross-Origin-Resource-Policy': 'cross-origin', 'Access-Control-Allow-Origin': '*' };
const HOSTS = new Set(['127.0.0.1', 'localhost']); // other names may be those of other sites (DNS rebinding)
const METHODS = new Set(['GET', 'HEAD']);

// Returns the path of a folder with a slash at its end if the request names a folder without it, otherwise null. Throws an error if the
// URL is invalid.
function folderPath(folder, url) {
    const { pathname } = new URL(url, 'http://x'), path = resolve(join(folder, decodeURIComponent(pathname)));
    const isFolder = path.startsWith(folder + sep) && statSync(path, { throwIfNoEntry: false })?.isDirectory();
    return isFolder && !pathname.endsWith('/') ? `${pathname.replace(/^\/+/, '/')}/` : null;
}

// Serves a folder. The promise fails if the port cannot be used.
export function serve(folder, port = 0) {
    const refuse = (response, status, text, headers = {}) =>
        response.writeHead(status, { 'Content-Type': 'text/plain', ...headers }).end(`${text}\n`);
    const files = sirv(folder, {
        dev: true, etag: true, // the files are read again for each request, because `./dev web` may have changed them
        onNoMatch: (request, response) => refuse(response, 404, 'no such file'),
        setHeaders: response => Object.entries(HEADERS).forEach(([name, value]) => response.setHeader(name, value)),
    });
    const server = createServer((request, response) => {
        const { method, url, headers } = request;
        if (!HOSTS.has(headers.host?.replace(/:\d+$/, '')))
            return refuse(response, 403, 'unknown host: open the page at 127.0.0.1 or localhost');
        if (!METHODS.has(method))
            return refuse(response, 405, 'only GET and HEAD are allowed', { Allow: 'GET, HEAD' });
        try {
            const moved = folderPath(resolve(folder), url);
            if (moved)
                return refuse(response, 301, `moved to ${moved}`, { Location: moved });
            return files(request, response);
        } catch { // an invalid %-sequence, host, NUL or range, or a name that is too long for the file system
            return response.headersSent ? response.destroy() : refuse(response, 400, 'bad request');
        }
    });
    return new Promise((done, fail) => server.on('error', fail).listen(port, '127.0.0.1', () =>
        done({ url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() })));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [, , folder, port = '0'] = process.argv;
    process.on('uncaughtException', error => console.error(`petri: ${error.message}`)); // a file that cannot be read
    try {
        const { url } = await serve(folder, Number(port));
        console.log(`petri is at ${url}; press Ctrl-C to stop the server`);
    } catch (error) {
        console.error(error.code === 'EADDRINUSE'
            ? `petri: port ${port} is in use; name another, such as ./dev web --serve ${Number(port) + 1}`
            : `petri: cannot serve on port ${port}: ${error.message}`);
        process.exitCode = 1;
    }
}

// serve.test.mjs: the local server survives bad requests and serves only its folder. Needs no browser.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const page = join(dirname(fileURLToPath(import.meta.url)), '../../src/web/page');
const options = { skip: existsSync(join(page, 'node_modules/sirv')) ? false : 'missing: sirv', timeout: 60000 };
const { serve } = options.skip ? {} : await import('../../src/web/page/serve.mjs');

// Sends a request with a path that is sent as it is, which fetch would correct. Returns the status and the headers.
function answerTo(url, path, { method = 'GET', host = '127.0.0.1', more = '' } = {}) {
    return new Promise((resolve, reject) => {
        const socket = connect(Number(new URL(url).port), '127.0.0.1', () =>
            socket.write(`${method} ${path} HTTP/1.0\r\n${host ? `Host: ${host}\r\n` : ''}${more}\r\n`));
        let text = '';
        socket.on('data', data => { text += data; }).on('error', reject).on('end', () => {
            const [head, ...body] = text.split('\r\n\r\n');
            const headers = Object.fromEntries(head.split('\r\n').slice(1).map(line => line.split(/: ?/)));
            resolve({ status: Number(text.split(' ')[1]), headers, body: body.join('\r\n\r\n') });
        });
    });
}

async function served(use) {
    const folder = mkdtempSync(join(tmpdir(), 'petri-serve-'));
    writeFileSync(join(folder, 'index.html'), 'petri');
    mkdirSync(join(folder, 'manual'));
    writeFileSync(join(folder, 'manual/index.html'), 'manual');
    const server = await serve(folder);
    try {
        await use((path, how) => answerTo(server.url, path, how), server, folder);
    } finally {
        server.close();
        rmSync(folder, { recursive: true });
    }
}

test('the server answers bad requests and continues', options, () => served(async ask => {
    for (const path of ['/%', '/%ff', '/%00', `/${'a'.repeat(7000)}`, '//', '//[', '*', 'x'])
        assert.ok([400, 404].includes((await ask(path)).status), path.slice(0, 20));
    for (const path of ['/../../../../etc/passwd', '/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd', '/..%2f..%2f..%2f..%2fetc/passwd'])
        assert.equal((await ask(path)).status, 404, path);
    for (const range of ['bytes=3-1', 'bytes=99-', 'bytes=-', 'x'])
        await ask('/index.html', { more: `Range: ${range}\r\n` });
    assert.equal((await ask('/')).body, 'petri');
}));

test('only GET and HEAD for this host are answered', options, () => served(async ask => {
    for (const method of ['POST', 'PUT', 'DELETE', 'OPTIONS'])
        assert.equal((await ask('/', { method })).status, 405, method);
    assert.equal((await ask('/', { method: 'HEAD' })).body, '');
    for (const host of ['evil.example', 'evil.example:80', '127.0.0.1.evil.example', ''])
        assert.equal((await ask('/', { host })).status, 403, host);
    for (const host of ['localhost:8080', '127.0.0.1:1'])
        assert.equal((await ask('/', { host })).status, 200, host);
}));

test('a folder without a slash is redirected, within this server', options, () => served(async ask => {
    const { status, headers } = await ask('/manual');
    assert.deepEqual([status, headers.Location], [301, '/manual/']);
    assert.equal((await ask('/manual/')).body, 'manual');
    const other = await ask('//manual');
    assert.ok(!other.headers.Location || /^\/[^/]/.test(other.headers.Location), JSON.stringify(other));
}));

test('an unchanged file is not sent again', options, () => served(async (ask, server, folder) => {
    const { headers } = await ask('/'), again = { more: `If-None-Match: ${headers.ETag}\r\n` };
    assert.equal((await ask('/', again)).status, 304);
    writeFileSync(join(folder, 'index.html'), 'changed');
    assert.equal((await ask('/', again)).body, 'changed');
}));

test('a port in use is reported in one line', options, () => served(async (ask, server, folder) => {
    const { port } = new URL(server.url), child = spawn(process.execPath, [join(page, 'serve.mjs'), folder, port]);
    let text = '';
    child.stderr.on('data', data => { text += data; });
    const status = await new Promise(resolve => child.on('close', resolve));
    assert.deepEqual([status, text], [1, `petri: port ${port} is in use; name another, such as ./dev web --serve ${Number(port) + 1}\n`]);
}));

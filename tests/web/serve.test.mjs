// serve.test.mjs: the development server survives bad requests and serves only its folder. Needs no browser.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { serve } from '../../src/web/page/serve.mjs';

// Returns the status of a request whose path is sent as it is, which fetch would correct.
function statusOf(url, path) {
    return new Promise((resolve, reject) => {
        const socket = connect(Number(new URL(url).port), '127.0.0.1', () => socket.write(`GET ${path} HTTP/1.0\r\n\r\n`));
        let text = '';
        socket.on('data', data => { text += data; }).on('end', () => resolve(Number(text.split(' ')[1]))).on('error', reject);
    });
}

test('the server answers bad requests and continues', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'petri-serve-'));
    writeFileSync(join(folder, 'index.html'), 'petri');
    const server = await serve(folder);
    try {
        for (const path of ['/%', '/%ff', '/%00', `/${'a'.repeat(7000)}`, '//'])
            assert.ok([400, 404].includes(await statusOf(server.url, path)), path.slice(0, 20));
        for (const path of ['/../../../../etc/passwd', '/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd', '/..%2f..%2f..%2f..%2fetc/passwd'])
            assert.equal(await statusOf(server.url, path), 404, path);
        assert.equal(await statusOf(server.url, '/'), 200);
    } finally {
        server.close();
        rmSync(folder, { recursive: true });
    }
});

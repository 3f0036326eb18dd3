// link.test.mjs: links from the page to `petri run`, and from `petri link` to the page. Skipped without petri or the libraries for links.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { deflateRawSync } from 'node:zlib';
import { packLink } from '../../src/web/page/link.mjs';
import { atFrame, frameOf, opened, options, root } from './browser.mjs';

const petri = join(root, 'build/petri'), tried = spawnSync(petri, ['run', '#'], { encoding: 'utf8' });
const ways = { ...options, skip: options.skip || (tried.error || /built without/.test(tried.stderr) ? 'petri opens no links' : false) };
const linked = (...words) => execFileSync(petri, ['link', join(root, 'samples/dish.fl'), ...words], { encoding: 'utf8' }).trim();

test('a link of petri opens in the page with the same state', ways, async () => {
    for (const [frame, words] of [[0, []], [12, ['-D', 'DROPS=9']]])
        await opened(linked('--frame', String(frame), ...words), {
            use: async page => {
                await atFrame(page, frame);
                await page.waitForFunction(() => document.getElementById('message').textContent !== '');
                assert.match(await page.textContent('#message'), /the state matches the link exactly \(digest [0-9a-f]{32}\)/);
                assert.equal(await page.inputValue('#parameter-DROPS'), words.length ? '9' : '220');
            },
        });
});

test('a link of petri 0.2 is compared by its hash', ways, async () => {
    const text = '!counter state=:c rate=3\n';
    const script = join(mkdtempSync(join(tmpdir(), 'petri-')), 'c.fl');
    writeFileSync(script, text);
    const printed = execFileSync(petri, ['run', script, '--frames', '5', '--every', '4', '--print', 'hash'], { encoding: 'utf8' });
    const hash = printed.trim().slice(-64);
    const same = `Frame 4: the state matches the link exactly (SHA-256 ${hash}).`;
    for (const [h, message] of [[hash, same], ['0'.repeat(64), 'differs from the link']]) {
        const link = `#${deflateRawSync(JSON.stringify({ v: 1, t: text, n: 'c.fl', f: 4, h })).toString('base64url')}`;
        await opened(link, {
            use: async page => {
                await page.waitForFunction(() => document.getElementById('message').textContent !== '');
                assert.ok((await page.textContent('#message')).includes(message));
            },
        });
    }
});

// With `petri run --work 1M LINK`, the limit of the link is 3 * 2^20. The page has no options, so the test changes its limit.
test('a link that exceeds the limit of work stops in the page after the same frame as in petri', ways, async () => {
    const LIMIT = 3 * 2 ** 20, text = '!a v=len(i for i in ..300000+0*frame)\n!counter state=:c rate=1\n';
    const link = await packLink({ text, name: 'heavy.fl', changes: [], frame: 1000000, digest: '0'.repeat(32) });
    const { status, stderr } = spawnSync(petri, ['run', '--work', '1M', link], { encoding: 'utf8' });
    assert.equal(status, 1);
    const [, frame] = stderr.match(new RegExp(`stopped after frame (\\d+): the link exceeded its limit of ${LIMIT} units`));
    await opened(link, {
        prepare: page => page.route('**/worker.js*', async route => {
            const response = await route.fetch(), body = await response.text();
            const changed = body.replace(/[\w.]+\.web_link_work_limit\(\)/, LIMIT);
            assert.notEqual(changed, body);
            await route.fulfill({ response, body: changed });
        }),
        use: async page => {
            await page.waitForFunction(() => document.getElementById('message').textContent !== '');
            assert.equal(await page.textContent('#message'),
                `Stopped after frame ${frame}: opening exceeded the limit of ${LIMIT} units of work.`);
            assert.equal(await frameOf(page), Number(frame));
            await page.click('#step'); // the limit applies only to opening
            await atFrame(page, Number(frame) + 1);
        },
    });
});

test('a link of the page opens in petri with the changed parameters', ways, () => opened(linked('-D', 'DROPS=9', '--frame', '5'), {
    use: async page => {
        await atFrame(page, 5);
        await page.fill('#parameter-DROPS', '14');
        await page.press('#parameter-DROPS', 'Enter');
        for (let frame = 6; frame < 9; frame++) {
            await page.click('#step');
            await atFrame(page, frame);
        }
        const before = await page.evaluate(() => location.hash);
        await page.click('#link');
        await page.waitForFunction(hash => location.hash !== hash, before);
        const { status, stderr } = spawnSync(petri, ['run', await page.evaluate(() => location.href)], { encoding: 'utf8' });
        assert.match(stderr, /frame 8: state matches the link exactly/);
        assert.equal(status, 0);
    },
}));

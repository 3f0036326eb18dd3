// standalone.test.mjs: tests the page that `petri link --html` writes, opened as a local file.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { folder, options, pixels, root, visited, world } from './browser.mjs';

const petri = join(root, 'build/petri'), page = join(folder, 'standalone.html'), scratch = mkdtempSync(join(tmpdir(), 'petri-'));
const env = { ...process.env, PETRI_STANDALONE: page };
const ways = { ...options, skip: options.skip || (existsSync(petri) && existsSync(page) ? false : 'missing: petri or the page') };
after(() => rmSync(scratch, { recursive: true }));

const write = (script, file, ...words) => execFileSync(petri, ['link', script, '--html', join(scratch, file), ...words], { env });
const digestOf = (script, frame, ...words) => execFileSync(petri,
    ['run', script, '--frames', `${frame + 1}`, '--every', `${Math.max(frame, 1)}`, '--print', 'digest', ...words], { encoding: 'utf8' })
    .match(/[0-9a-f]{32}(?=\n*$)/)[0];

// Opens the file without a network, and verifies its stored digest.
const opened = (file, use, settings = {}) => visited(`${pathToFileURL(join(scratch, file))}`, {
    settings: { offline: true, reducedMotion: 'no-preference', ...settings }, ready: () => document.body.dataset.verified,
    prepare: page => page.on('request', request => assert.match(request.url(), /^(file|blob|data):/)), use,
});

test('a page on the disk moves, and has the digest of petri run', ways, () => {
    const script = join(root, 'samples/dish.fl'), wanted = digestOf(script, 60, '-D', 'DROPS=50');
    write(script, 'dish.html', '--frame', '60', '-D', 'DROPS=50');
    return opened('dish.html', async page => {
        assert.equal(await page.evaluate(() => document.body.dataset.verified), 'true');
        assert.equal(await page.textContent('#hash'), `Frame 60: digest of the state ${wanted} ✓ as stored in this file`);
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 60);
        const { sum, all } = await pixels(page);
        assert.ok(all > 20);
        const at = await page.evaluate(() => Number(document.body.dataset.frame));
        await page.waitForFunction(frame => Number(document.body.dataset.frame) > frame + 5, at);
        assert.notEqual((await pixels(page)).sum, sum);
        assert.equal(await page.textContent('#script'), readFileSync(script, 'utf8'));
        const link = await page.getAttribute('#links a', 'href');
        assert.match(link, /^http:\/\/127\.0\.0\.1:8080\/#/);
        await visited(world.server.url + link.slice(link.indexOf('#')), {
            ready: () => /matches the link exactly/.test(document.getElementById('message').textContent),
            use: async other => assert.ok((await other.textContent('#message')).includes(wanted)),
        });
    });
});

test('a page contains the files that the script reads, also with markup in them', ways, () => {
    const script = join(scratch, 'own.fl');
    mkdirSync(join(scratch, 'lib'));
    writeFileSync(join(scratch, 'lib/shade.fl'), 'let shade=0.2;0.9;0.4\n');
    writeFileSync(join(scratch, 'text.txt'), '</script><script>alert(1)</script>');
    writeFileSync(script, 'import shade from "lib/shade.fl"\nlet WORDS=read("text.txt")\n!counter state=:c rate=shade[1] id=WORDS\n'
        + '!window size=40;30\n    !canvas\n'
        + '        !rect size=40;30 color=shade fill=true\n-- </script> <!-- é\n');
    write(script, 'own.html', '--frame', '30');
    return opened('own.html', async page => {
        assert.ok((await page.textContent('#hash')).includes(`${digestOf(script, 30)} ✓`));
        assert.equal(await page.textContent('#script'), readFileSync(script, 'utf8'));
        assert.match(await page.textContent('#links'), /lib\/shade\.fl/);
        const colour = await page.locator('#picture').evaluate(canvas => [...canvas.getContext('2d').getImageData(1, 1, 1, 1).data]);
        assert.deepEqual(colour, [51, 230, 102, 255]);
    }, { viewport: { width: 390, height: 844 } });
});

test('a page with a wrong digest says so and does not run', ways, () => {
    const script = join(root, 'samples/hello.fl');
    write(script, 'wrong.html', '--frame', '3');
    const file = join(scratch, 'wrong.html'), html = readFileSync(file, 'utf8');
    const other = execFileSync(petri, ['link', script, '--frame', '5'], { encoding: 'utf8' }).trim();
    execFileSync(process.execPath, ['--input-type=module', '-e', `
        import { packLink, readLink } from ${JSON.stringify(join(root, 'src/web/page/link.mjs'))};
        import { writeFileSync } from 'node:fs';
        const link = await packLink({ ...await readLink(${JSON.stringify(other)}), digest: '0'.repeat(32) });
        writeFileSync(${JSON.stringify(join(scratch, 'link'))}, link);`]);
    writeFileSync(file, html.replace(/"link": ?"[^"]*"/, `"link":"${readFileSync(join(scratch, 'link'), 'utf8')}"`));
    return opened('wrong.html', async page => {
        assert.equal(await page.evaluate(() => document.body.dataset.verified), 'false');
        assert.match(await page.textContent('#hash.error'), /✗ this file has 0{32}/);
        assert.equal(await page.textContent('#run'), 'Run');
    });
});

test('the command names what is missing', ways, () => {
    const script = join(root, 'samples/hello.fl'), file = join(scratch, 'none.html');
    const { status, stderr } = spawnSync(petri, ['link', script, '--html', file],
        { encoding: 'utf8', env: { ...env, PETRI_STANDALONE: join(scratch, 'absent.html') } });
    assert.equal(status, 1);
    assert.match(stderr, /standalone\.html, is not installed; copy it from petri-[\d.]+-page\.tar\.xz .* and set PETRI_STANDALONE/);
    assert.equal(existsSync(file), false);
});

test('the npm package writes the same page', ways, () => {
    const script = join(root, 'samples/dish.fl'), cli = join(folder, 'petri/cli.mjs');
    write(script, 'native.html', '--frame', '10');
    execFileSync(process.execPath, [cli, 'link', script, '--html', join(scratch, 'npm.html'), '--frame', '10']);
    assert.equal(readFileSync(join(scratch, 'npm.html'), 'utf8').match(/"petri-engine">[^<]*/)[0],
        readFileSync(join(scratch, 'native.html'), 'utf8').match(/"petri-engine">[^<]*/)[0]);
    return opened('npm.html', async page => assert.equal(await page.evaluate(() => document.body.dataset.verified), 'true'));
});

// command.test.mjs: the command of the npm package: paths of Windows, the sandbox, signals, size and start. PETRI_WEB is build/web.
// command.sh runs the suites of the native command.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const folder = join(process.env.PETRI_WEB, 'petri');
const load = name => import(pathToFileURL(join(folder, name)));
const { posixPaths, windowsPaths } = await load('paths.mjs');
const { System } = await load('system.mjs');

const cli = join(folder, 'cli.mjs');
const petri = (args, options) => spawnSync('node', [cli, ...args], { encoding: 'utf8', ...options });

// Calls `use` with a new folder.
function within(use) {
    const work = fs.realpathSync(fs.mkdtempSync(join(tmpdir(), 'petri-command-')));
    try {
        return use(work);
    } finally {
        fs.rmSync(work, { recursive: true });
    }
}

test('paths of Windows become POSIX paths and back', () => {
    for (const [system, path] of [['C:\\dir\\a.fl', '/C:/dir/a.fl'], ['C:\\', '/C:/'], ['\\\\server\\share\\a', '//server/share/a']]) {
        assert.equal(windowsPaths.fromSystem(system), path);
        assert.equal(windowsPaths.toSystem(path), system);
    }
    assert.equal(windowsPaths.fromSystem('\\\\?\\C:\\dir'), '/C:/dir');
    assert.equal(windowsPaths.fromSystem('\\\\?\\UNC\\server\\share\\a'), '//server/share/a');
    assert.equal(windowsPaths.toSystem(Buffer.from('/C:/é.fl').toString('latin1')), 'C:\\é.fl');
    assert.equal(windowsPaths.toSystem('/dev/null'), '\\\\.\\nul');
    assert.deepEqual(posixPaths.toSystem('/a\xff'), Buffer.from([0x2f, 0x61, 0xff]));
});

test('arguments of Windows that are paths are converted, others are not', () => {
    const known = ['dir\\a.fl', 'dir', 'out'];
    const convert = argument => windowsPaths.fromArgument(argument, path => known.includes(path));
    assert.equal(convert('dir\\a.fl'), 'dir/a.fl');
    assert.equal(convert('dir\\new.csv'), 'dir/new.csv');
    assert.equal(convert('C:\\x.fl'), '/C:/x.fl');
    assert.equal(convert('C:/x.fl'), '/C:/x.fl');
    assert.equal(convert('--output=out\\x.csv'), '--output=out/x.csv');
    assert.equal(convert('--output=D:\\x.csv'), '--output=/D:/x.csv');
    assert.equal(convert('NAME="a\\b"'), 'NAME="a\\b"');
    assert.equal(convert('a:b'), 'a:b');
    assert.equal(convert('--quiet'), '--quiet');
});

const O_NOFOLLOW = 0x20000, O_DIRECTORY = 0x10000, ELOOP = 'ELOOP';
const systemIn = (work, procfs) => new System({ args: [], environment: [], folder: work, windows: false, procfs });

for (const procfs of fs.existsSync('/proc/self/fd') ? [true, false] : [false]) {
    test(`no link leads out of an open folder (${procfs ? 'with' : 'without'} /proc)`, () => within(work => {
        fs.mkdirSync(join(work, 'inside/sub'), { recursive: true });
        fs.mkdirSync(join(work, 'outside'));
        fs.writeFileSync(join(work, 'inside/a'), 'a');
        fs.writeFileSync(join(work, 'outside/a'), 'secret');
        fs.symlinkSync('../outside/a', join(work, 'inside/link'));
        fs.symlinkSync('../outside', join(work, 'inside/folder'));
        const system = systemIn(work, procfs), open = (at, name, flags) => system.open(at, name, flags, 0);
        const inside = open(-100, 'inside', O_DIRECTORY);
        assert.ok(open(inside, 'a', O_NOFOLLOW) > inside);
        assert.throws(() => open(inside, 'link', O_NOFOLLOW), { code: ELOOP });
        assert.throws(() => open(inside, 'folder', O_NOFOLLOW | O_DIRECTORY), error => ['ELOOP', 'ENOTDIR'].includes(error.code));
        assert.throws(() => open(-100, '', 0), { code: 'ENOENT' });
        // The folder is replaced with a link after it was opened.
        fs.renameSync(join(work, 'inside'), join(work, 'moved'));
        fs.symlinkSync('outside', join(work, 'inside'));
        if (procfs)
            assert.equal(fs.readFileSync(system.find(open(inside, 'a', O_NOFOLLOW)).real, 'utf8'), 'a');
        else
            assert.throws(() => open(inside, 'a', O_NOFOLLOW), { code: ELOOP });
        system.closeAll();
    }));
}

test('scripts read files only below their folder', () => within(work => {
    fs.mkdirSync(join(work, 'scripts'));
    fs.writeFileSync(join(work, 'secret'), 'secret');
    fs.writeFileSync(join(work, 'scripts/near'), 'near');
    fs.symlinkSync('../secret', join(work, 'scripts/link'));
    const script = join(work, 'scripts/a.fl');
    fs.writeFileSync(script, '!n a=read("near") b=read("../secret") c=read("link")\n');
    const run = petri(['run', script, '--frames', '1', '--print', 'tree']);
    assert.match(run.stdout, /!n a='near'\n/);
    assert.doesNotMatch(run.stdout, /secret/);
    assert.match(run.stderr, /scripts are not allowed to read there/);
    assert.match(petri(['run', script, '--frames', '1', '--print', 'tree', '--allow-read', work]).stdout, /b='secret' c='secret'/);
}));

test('deep recursion is reported as in the native command', () => within(work => {
    fs.writeFileSync(join(work, 'deep.fl'), 'func f(n)\n    f(n+1) if n < 1000000 else n\ndebug(f(0))\n');
    const run = petri(['run', 'deep.fl', '--frames', '1'], { cwd: work });
    assert.notEqual(run.status, 134, run.stderr);
}));

test('plans and HDF5 are reported as not supported', () => within(work => {
    const run = (...args) => petri(args, { cwd: work }).stderr;
    fs.writeFileSync(join(work, 'a.fl'), '!physics state=:p dimensions=1\n    !particle id=0 position=N\n');
    fs.writeFileSync(join(work, 'plan.yaml'), 'script: a.fl\n');
    assert.match(run('sweep', '--plan', 'plan.yaml'), /^petri: cannot read plan\.yaml: petri for Node\.js cannot read plans/);
    const table = /(^|\n)petri: cannot write a\.h5: petri for Node\.js does not write HDF5; use the suffix \.csv\n$/;
    assert.match(run('sweep', 'a.fl', '-D', 'N=1..2', '--frames', '1', '--metric', 'energy', '-o', 'a.h5'), table);
    assert.match(run('run', 'a.fl', '--frames', '1', '--trajectory', 'a.h5'), table);
}));

test('sweeps and tests have the same output with any number of threads', () => within(work => {
    fs.writeFileSync(join(work, 'a.fl'), `!physics state=:p dimensions=2
    for i in ..20
        !particle id=i position=20*uniform(:x;SEED)[2*i..2*i+2] radius=1
    !collision strength=A
    !drag foo=1
if SEED == 4
    !window size=1/0 foo=2
`);
    const sweep = (jobs, ...more) => petri(['sweep', 'a.fl', '-D', 'A=1..3', '--seeds', '5', '--frames', '9', '--every', '3', '--metric',
        'energy', '--jobs', jobs, ...more], { cwd: work });
    const [one, two] = [sweep('1'), sweep('2')];
    assert.deepEqual([one.status, one.stdout.split('\n').length], [0, 3 * 5 * 4 + 2]);
    assert.deepEqual([two.status, two.stdout], [one.status, one.stdout]);
    const lines = text => [...new Set(text.split('\n'))].sort();
    assert.ok(one.stderr.includes("unknown attribute 'foo'"));
    assert.deepEqual(lines(two.stderr), lines(one.stderr));
    // A table with some rows is completed, and the thread that loads the script reports its errors once.
    assert.equal(sweep('2', '--shard', '1/2', '-o', 'a.csv').status, 0);
    assert.equal(sweep('2', '--shard', '2/2', '-o', 'a.csv').status, 0);
    assert.equal(fs.readFileSync(join(work, 'a.csv'), 'utf8'), one.stdout);
    const tests = jobs => petri(['test', '--jobs', jobs, join(root, 'tests/golden'), join(root, 'samples/hello.fl')]).stdout;
    assert.match(tests('1'), /^[1-9]\d* passed, 0 failed/m);
    assert.equal(tests('2'), tests('1'));
}));

test('a sweep in threads ends with a signal and can be resumed', async () => {
    const work = fs.mkdtempSync(join(tmpdir(), 'petri-sweep-'));
    const args = ['sweep', join(root, 'samples/dish.fl'), '-D', 'DROPS=201..240', '--frames', '400', '--metric', 'energy', '--jobs', '2',
        '-o', join(work, 'a.csv')];
    const child = spawn('node', [cli, ...args], { stdio: ['ignore', 'ignore', 'pipe'] });
    let errors = '';
    child.stderr.on('data', data => { errors += data; });
    const rows = () => (fs.existsSync(join(work, 'a.csv.part')) ? fs.readFileSync(join(work, 'a.csv.part'), 'utf8').split('\n').length : 0);
    while (rows() < 6)
        await new Promise(resolve => setTimeout(resolve, 20));
    child.kill('SIGINT');
    assert.equal(await new Promise(resolve => { child.on('close', resolve); }), 130);
    assert.match(errors, /stopped; run the same command to resume/);
    fs.rmSync(work, { recursive: true });
});

test('SIGTERM ends a run with its summary', async () => {
    const options = ['--frames', '100000000', '--stats', '--print', 'hash'];
    const child = spawn('node', [cli, 'run', join(root, 'samples/dish.fl'), ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
    let errors = '';
    child.stderr.on('data', data => { errors += data; });
    await new Promise(resolve => { child.stdout.once('data', resolve); });
    child.stdout.resume();
    child.kill('SIGTERM');
    const status = await new Promise(resolve => { child.on('close', resolve); });
    assert.equal(status, 143);
    assert.match(errors, /frames/);
});

test('the command is small and starts quickly', () => {
    const size = name => gzipSync(fs.readFileSync(join(folder, name)), { level: 9 }).length;
    assert.ok(size('petri-command.wasm') <= 580e3 && size('petri-pictures.wasm') <= 1060e3);
    const seconds = command => Math.min(...Array.from({ length: 5 }, () => {
        const start = performance.now();
        assert.equal(spawnSync('node', command).status, 0);
        return performance.now() - start;
    }));
    // The machine may be busy, so that the time is compared with that of Node.js alone.
    const empty = seconds(['-e', '0']), run = seconds([cli, 'run', join(root, 'samples/hello.fl'), '--frames', '3']);
    assert.ok(run < 5 * empty, `${run} ms, of which Node.js takes ${empty} ms`);
});

test('npm installs the command', () => within(work => {
    const npm = args => spawnSync('npm', args, { cwd: work, encoding: 'utf8', env: { ...process.env, npm_config_offline: 'true' } });
    if (npm(['--version']).error)
        return;
    const [{ filename }] = JSON.parse(npm(['pack', '--json', folder]).stdout);
    assert.equal(npm(['install', '--no-audit', '--no-fund', `./${filename}`]).status, 0);
    const run = spawnSync(join(work, 'node_modules/.bin/petri'), ['--version'], { encoding: 'utf8' });
    assert.match(run.stdout, /^petri \d/);
}));

test('files that cannot be read are omitted', async () => {
    const { filesBelow } = await load('files.mjs');
    const work = fs.mkdtempSync(join(tmpdir(), 'petri-files-'));
    try {
        for (const name of ['a', 'b', 'c'])
            fs.mkdirSync(join(work, name));
        for (const name of ['a/a.fl', 'b/b.fl', 'c/c.fl', 'd.fl', 'empty.fl'])
            fs.writeFileSync(join(work, name), name === 'empty.fl' ? '' : '!n\n');
        // Folders and files disappear while others are read. Unlike missing permissions, this also happens to root.
        const removing = (bytes, name) => {
            fs.rmSync(join(work, 'b'), { recursive: true, force: true });
            fs.rmSync(join(work, 'd.fl'), { force: true });
            return name;
        };
        assert.deepEqual(Object.keys(filesBelow(work, removing)), ['a/a.fl', 'c/c.fl', 'empty.fl']);
        assert.throws(() => filesBelow(work, () => { throw new Error('of the reader'); }), /of the reader/);
        assert.throws(() => filesBelow(join(work, 'none')));
    } finally {
        fs.rmSync(work, { recursive: true });
    }
});

test('petri sweep --plot says where drawing works', () => within(work => {
    fs.writeFileSync(join(work, 'a.fl'), 'let A=A or 1\n\n!physics state=:s dimensions=1\n    !particle id=:p position=A velocity=1\n');
    const plot = petri(['sweep', 'a.fl', '-D', 'A=1;2', '--frames', '2', '--metric', 'x=$(:s;:p)', '--plot', 'p.png', '-o', 't.csv'],
        { cwd: work });
    assert.notEqual(plot.status, 0);
    assert.match(plot.stderr, /use the native petri/);
    assert.doesNotMatch(plot.stderr, /Debian/);
}));

test('petri link finds image files without drawing, and reports nothing else', () => within(work => {
    const canvas = lines => `!window size=64;32\n    !canvas\n${lines.map(line => `        ${line}\n`).join('')}`;
    const link = (lines, ...words) => {
        fs.writeFileSync(join(work, 'a.fl'), canvas(lines));
        return petri(['link', 'a.fl', ...words], { cwd: work });
    };
    const plain = link(['!rect size=64;32 fill=true color=1']);
    assert.deepEqual([plain.status, plain.stderr], [0, '']);
    assert.match(plain.stdout, /^#[\w-]+\n$/);
    const names = ['one.png', 'zwölf.png', 'dir/three.png'];
    // Files are found behind and between all kinds of operands.
    const drawn = ['!text text="three.png" font_size=9 fill=true', `!image filename="${names[0]}"`,
        '!group', '    !dash intervals=10;5', '    !line points=0;0;5;5 stroke=true', `    !image filename="${names[1]}" size=4;4`,
        '!group', '    !dilate radius=4;1', '    !line points=0;0;5;5 stroke=true', '!gradient start=5;0 end=60;0', '    !stop color=1;0;0',
        '    !stop color=1;1;0', '!rect size=9;9 fill=true stroke=true', `!image filename="${names[2]}" point=3;3`];
    const refused = link(drawn);
    assert.equal(refused.status, 1);
    assert.match(refused.stderr, new RegExp(`cannot link a script that reads files: ${names.join(', ')};`));
    assert.doesNotMatch(refused.stderr, /cannot draw/);
    fs.mkdirSync(join(work, 'dir'));
    names.forEach((name, i) => fs.writeFileSync(join(work, name), `bytes ${i}`));
    const page = link(drawn, '--html', 'out.html');
    assert.deepEqual([page.status, page.stderr], [0, '']);
    const data = fs.readFileSync(join(work, 'out.html'), 'utf8').match(/id="petri-data">([^<]*)</)[1], { files } = JSON.parse(data);
    assert.deepEqual(Object.entries(files).map(([name, bytes]) => [name, String(Buffer.from(bytes, 'base64'))]),
        names.map((name, i) => [name, `bytes ${i}`]));
}));

test('petri view serves the script below a token, and reloads it', async () => {
    const { linkTo, serveScript } = await load('view.mjs'), { filesBelow } = await load('files.mjs');
    const work = fs.mkdtempSync(join(tmpdir(), 'petri-view-'));
    fs.mkdirSync(join(work, 'scripts/lib'), { recursive: true });
    fs.writeFileSync(join(work, 'secret'), 'secret');
    fs.symlinkSync('../secret', join(work, 'scripts/link'));
    fs.writeFileSync(join(work, 'scripts/lib/m.fl'), 'let a=1\n');
    const script = join(work, 'scripts/a.fl');
    fs.writeFileSync(script, '!n a=1\n');
    assert.deepEqual(filesBelow(join(work, 'scripts')), { 'a.fl': '!n a=1\n', 'lib/m.fl': 'let a=1\n' });
    const { url, close } = await serveScript(script);
    try {
        assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$/);
        const status = async path => (await fetch(new URL(path, url))).status;
        const text = async path => (await fetch(new URL(path, url))).text();
        assert.equal(await status('/'), 404);
        assert.equal(await status(`/${'0'.repeat(32)}/`), 404);
        for (const path of ['../../package.json', '%2e%2e/cli.mjs', 'offline.js', 'a.fl'])
            assert.equal(await status(path), 404, path);
        for (const path of ['', 'page.js', 'worker.js', 'petri/engine.wasm', 'petri/engine-archives.wasm', 'petri/engine-scalar.wasm'])
            assert.equal(await status(path), 200, path);
        const icon = await fetch(new URL('icon.svg', url)); // browsers show no picture of another type
        assert.equal(icon.headers.get('content-type'), 'image/svg+xml');
        await icon.text();
        assert.ok((await text('')).includes('<script src="view.js">'));
        assert.ok((await text('view.js')).includes(linkTo('!n a=1\n', 'a.fl')));
        assert.equal(JSON.parse(await text('samples.json')).files['lib/m.fl'], 'let a=1\n');
        const events = await fetch(new URL('events', url)), reader = events.body.getReader();
        fs.writeFileSync(script, '!n a=2\n');
        const { value } = await reader.read();
        assert.equal(Buffer.from(value).toString(), `data: ${linkTo('!n a=2\n', 'a.fl')}\n\n`);
        await reader.cancel();
    } finally {
        close();
        fs.rmSync(work, { recursive: true });
    }
});

test('petri view ends with Ctrl-C, and rejects other arguments', async () => {
    assert.equal(petri(['view']).status, 2);
    assert.equal(petri(['view', '--frames=1', 'a.fl']).status, 2);
    assert.match(petri(['view', 'missing.fl']).stderr, /^petri: cannot read 'missing.fl': No such file or directory\n$/);
    assert.match(petri(['view', '--help']).stdout, /^usage: petri view/);
    const child = spawn('node', [cli, 'view', join(root, 'samples/hello.fl')], { env: { ...process.env, DISPLAY: '', BROWSER: '' } });
    const text = await new Promise(resolve => { child.stdout.once('data', resolve); });
    assert.match(String(text), /^petri shows .*hello\.fl at http:\/\/127\.0\.0\.1:/);
    child.kill('SIGINT');
    assert.equal(await new Promise(resolve => { child.on('close', resolve); }), 130);
});

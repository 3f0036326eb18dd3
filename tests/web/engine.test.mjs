// engine.test.mjs: tests the npm package: the example of its README, and error cases. PETRI_WEB is build/web.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const folder = join(process.env.PETRI_WEB, 'petri');
const { loadEngine, PetriError } = await import(pathToFileURL(join(folder, 'petri.mjs')));
const read = name => readFileSync(join(root, name), 'utf8');
const engine = await loadEngine();
const opened = (text, options) => engine.open(options).load(text);
const stepped = (session, count) => {
    for (let i = 0; i < count; i++)
        session.step();
    return session;
};
const DISH = read('samples/dish.fl');

test('the package has the version of the project and is small', () => {
    const version = read('meson.build').match(/version: '([0-9.]+)'/)[1];
    assert.equal(engine.version, version);
    assert.equal(JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')).version, version);
    const size = name => gzipSync(readFileSync(join(folder, name)), { level: 9 }).length;
    assert.ok(size('engine.wasm') <= 560e3 && size('engine-scalar.wasm') <= 560e3 && size('engine-archives.wasm') <= 860e3);
});

test('links of the README lead somewhere in a registry', () => {
    const links = [...readFileSync(join(folder, 'README.md'), 'utf8').matchAll(/\]\(([^)]*)\)/g)].map(([, link]) => link);
    assert.ok(links.length > 0);
    assert.deepEqual(links.filter(link => !/^https:\/\/[^@]*$/.test(link)), []);
});

// The linker permits missing functions (src/web/meson.build). They return -52, which callers may take for an address.
test('every OpenGL function that the engine calls is implemented', async () => {
    const { Screen } = await import(pathToFileURL(join(folder, 'webgl.mjs')));
    const { functions } = new Screen({});
    const module = new WebAssembly.Module(readFileSync(join(folder, 'engine.wasm')));
    const called = WebAssembly.Module.imports(module).map(({ name }) => name).filter(name => /^gl[A-Z]/.test(name));
    assert.ok(called.length > 50);
    assert.deepEqual(called.filter(name => !functions[name]), []);
});

test('after the WebGL context is restored, the names of lost objects are unused, and calls of a lost context do nothing', async () => {
    const { Screen } = await import(pathToFileURL(join(folder, 'webgl.mjs')));
    const screen = new Screen({}), used = [], texture = {};
    screen.gl = { isContextLost: () => used.length > 1, bindTexture: (target, object) => used.push(object), getExtension: () => null };
    const name = screen.add(texture);
    screen.functions.glBindTexture(0, name);
    screen.restore();
    screen.functions.glBindTexture(0, name);
    assert.equal(screen.functions.glBindTexture(0, name), 0);
    assert.deepEqual(used, [texture, null]);
});

test('the example of README gives its values', async () => {
    const [, code] = read('src/web/engine/README.md').match(/```js\n([^]*?)```/);
    const act = code.replace("'./petri/petri.mjs'", JSON.stringify(pathToFileURL(join(folder, 'petri.mjs')).href));
    const shown = act.replace('session.digest();', 'globalThis.shown = [session.frame.number, session.state.get(":p;2"), '
        + 'session.systems[0].position.data[2 * session.systems[0].position.stride + 1], session.evaluate("$(:p;2)[1]").number, '
        + 'session.digest()];');
    await import(`data:text/javascript,${encodeURIComponent(shown)}`);
    const [number, place, seen, evaluated, digest] = globalThis.shown;
    assert.equal(number, 59);
    assert.equal(place.length, 2);
    assert.ok(place[1] < -4 && place[1] > -5, `${place}`);
    assert.equal(seen, place[1]);
    assert.equal(evaluated, place[1]);
    assert.match(digest, /^[0-9a-f]{32}$/);
});

test('petri.d.ts declares exactly the methods that exist', () => {
    const types = read('src/web/engine/petri.d.ts').match(/interface Session \{([^]*?)\n\}/)[1];
    const declared = [...types.matchAll(/^ {4}(?:readonly )?(\w+)[(:]/gm)].map(match => match[1]).sort();
    const session = engine.open();
    const inner = ['constructor', 'run', 'check', 'with', 'report', 'readFile', 'listFolder', 'addColumn', 'drawCanvas', 'imagePixels',
        'openPainter', 'closePainter', 'forgetPicture', 'drawList', 'servePainter', 'actForPrompt'];
    const real = Object.getOwnPropertyNames(Object.getPrototypeOf(session)).filter(name => !inner.includes(name)).sort();
    assert.deepEqual(declared, real);
    session.close();
});

test('the limit of work for links is three times the default limit of `petri run --work`', () => {
    assert.equal(engine.memory.wasm.web_link_work_limit(), 3 * 2 ** 30);
    const session = opened(DISH), loaded = session.work;
    assert.ok(loaded > 0);
    const first = session.step().work - loaded;
    assert.ok(first > 1000 && session.step().work > loaded + first, `${first}`);
    session.close();
});

test('rewind gives the same frames again', () => {
    const session = stepped(opened(DISH), 20), kept = session.snapshot();
    assert.ok(kept.bytes > 0);
    const hash = stepped(session, 10).hash();
    session.rewind(kept);
    assert.equal(session.frame.number, 19);
    assert.notEqual(session.hash(), hash);
    assert.equal(stepped(session, 10).hash(), hash);
    kept.free();
    session.close();
});

test('the contributions to a force have the sum of the explanation, and lines of the script', () => {
    const session = engine.open({ keepForces: true });
    session.load(read('tests/repl/forces.fl'), 'forces.fl').step().step();
    assert.equal(session.particleId(0, 1), '1');
    assert.equal(session.particleId(0, 99), null);
    const { contributions, sum } = session.explain(0, 1);
    // the values of tests/repl/why.session
    assert.deepEqual(contributions.map(({ kind, partner, file, line }) => [kind, partner, file && `${file}:${line}`]),
        [[null, null, null], ['collision', '0', 'forces.fl:12'], ['collision', '2', 'forces.fl:12'], ['constant', null, 'forces.fl:7']]);
    assert.deepEqual(contributions[1].vector, [0.4980451839876881, 0.0006476530350945229]);
    assert.deepEqual(sum, [0.9986964138710219, 15.000431015824631]);
    const total = contributions.slice(1).reduce((before, { vector }) => before.map((x, k) => x + vector[k]), contributions[0].vector);
    assert.deepEqual(total, sum);
    assert.throws(() => session.explain(0, 99), { status: 'invalid' });
    assert.throws(() => session.explain(9, 0), { status: 'invalid' });
    session.close();
    const without = stepped(opened(DISH), 3);
    assert.throws(() => without.explain(0, 0), { status: 'invalid' });
    without.close();
});

test('an error has a position and leaves the running script unchanged', () => {
    const session = stepped(opened('!a x=frame\n'), 2);
    assert.throws(() => session.load('!a\n!b x=(\n', 'bad.fl'), error => {
        assert.ok(error instanceof PetriError);
        assert.equal(error.status, 'invalid');
        const [first] = error.diagnostics;
        assert.deepEqual([first.level, first.file, first.line, first.code], ['error', 'bad.fl', 2, 'syntax']);
        return error.message.includes('bad.fl:2:');
    });
    assert.match(session.step().print('tree'), /!a x=2/);
    assert.deepEqual(session.diagnose('!a x=coss(1)\n').map(one => [one.level, one.code, one.column, one.endColumn]),
        [['warning', 'unbound-name', 6, 10]]);
    assert.deepEqual(session.diagnose('!a x=1\n'), []);
    session.close();
});

test('a frame that exceeds a limit is aborted, and the session continues', () => {
    const session = opened('let n=N or 3\nlet k=(1 for i in ..n for j in ..1000 for k in ..1000)\n!a x=len(k)\n', { memory: 64 << 20 });
    const failsWith = status => error => error.status === status;
    session.load('!a x=sum(i*j for i in ..100000 for j in ..100000)\n');
    assert.throws(() => session.step(), failsWith('limit'));
    session.load('!a x=len((1 for i in ..10000000))\n');
    assert.throws(() => session.step(), failsWith('limit'));
    assert.match(session.load('!a x=1\n').step().print('tree'), /!a x=1/);
    session.close();
});

test('shouldInterrupt ends a long call, which changes nothing', () => {
    let asked = 0, wanted = false;
    const session = engine.open({ shouldInterrupt: () => (asked++, wanted) });
    session.load('!counter state=:c rate=1\n!a x=sum(i*j for i in ..3000 for j in ..(3000 if frame==2 else 1))\n').step().step();
    const before = session.print('state');
    [asked, wanted] = [0, true];
    assert.throws(() => session.step(), error => error.status === 'interrupted');
    assert.equal(asked, 1);
    wanted = false;
    assert.equal(session.print('state'), before);
    assert.equal(session.step().frame.number, 2);
    assert.ok(asked > 100, `${asked}`);
    session.close();
});

test('an interrupt does not affect the next call', () => {
    let wanted = false;
    const session = engine.open({ shouldInterrupt: () => wanted });
    const script = 'let N=N or 3\n!counter state=:c rate=1\n!physics state=:p dimensions=2 time=time\n    for i in ..2000\n'
        + "        !particle id=(:q;i) position=i;0 charge='word'\n!window\n    !canvas\n        !rect size=9;9\n";
    session.load(script).step().step();
    const whole = { state: session.state, parameters: session.parameters, systems: session.systems.length, table: session.table().text,
        picture: session.displayList().numbers, help: session.help(), tokens: session.tokens(script),
        evaluated: session.evaluate('sum(..99)'),
        diagnosed: session.diagnose(`${script}!x a=`).length, hash: session.hash(), symbol: session.symbolName(session.symbol('q')),
        drawable: true };
    const calls = { state: () => session.state, parameters: () => session.parameters, systems: () => session.systems.length,
        table: () => session.table().text, picture: () => session.displayList()?.numbers, help: () => session.help(),
        tokens: () => session.tokens(script), evaluated: () => session.evaluate('sum(..99)'), hash: () => session.hash(),
        diagnosed: () => session.diagnose(`${script}!x a=`).length, symbol: () => session.symbolName(session.symbol('q')),
        drawable: () => session.drawable };
    const ended = [];
    for (const [name, act] of Object.entries(calls)) {
        wanted = true;
        try {
            assert.deepEqual(act(), whole[name], name);
        } catch (error) {
            assert.equal(error.status, 'interrupted', `${name}: ${error.message}`);
            ended.push(name);
        }
        wanted = false;
        assert.doesNotThrow(() => session.print('hash'), name);
        assert.deepEqual(act(), whole[name], name);
    }
    assert.deepEqual(ended, ['table', 'evaluated', 'hash', 'diagnosed']);
    assert.equal(session.step().frame.number, 2);
    session.close();
});

test('deep recursion is reported, and the engine continues', () => {
    const names = Array.from({ length: 40 }, (_, i) => `f${i}`);
    const nested = '(1+' + '(2*'.repeat(150), end = ')'.repeat(151);
    const functions = names.map((name, i) => `func ${name}(fs, n)\n    ${nested}fs[${(i + 1) % 40}](fs, n-1)${end} if n>0 else 0\n`);
    const reported = [];
    const session = engine.open({ onDiagnostic: diagnostic => reported.push(diagnostic.code) });
    session.load(`${functions.join('')}let fs=${names.join(';')}\n!a x=f0(fs, 9000)\n`).step();
    assert.deepEqual(reported, ['recursion-depth']);
    session.load('func f(n)\n    1+f(n-1) if n>0 else 0\n!a x=f(499)\n');
    assert.match(session.step().print('tree'), /x=499/);
    session.close();
});

test('parameters are listed and can be set', () => {
    const session = opened('let SIZE=SIZE or 20 -- 1..100|5 how large\n!a x=SIZE\n').step();
    const [size] = session.parameters;
    assert.deepEqual([size.name, size.number, size.min, size.max, size.step, size.comment, size.settable],
        ['SIZE', 20, 1, 100, 5, 'how large', true]);
    assert.match(session.setParameter('SIZE', 30).step().print('tree'), /x=30/);
    assert.match(session.setParameter('SIZE', null).step().print('tree'), /x=20/);
    assert.throws(() => session.setParameter('OTHER', 1), /OTHER/);
    session.define('SIZE=40');
    assert.match(session.load('let SIZE=SIZE or 20\n!a x=SIZE\n').step().print('tree'), /x=40/);
    session.close();
});

test('scripts can read only the given files', () => {
    const session = engine.open({ files: { 'm.fl': 'let TEN=10\n', 'd/a.txt': 'été', 'd/b.txt': new Uint8Array([49]) } });
    session.load("import TEN from 'm.fl'\n!a x=TEN y=read('d/a.txt') z=glob('d/*') v=read('/etc/passwd')\n").step();
    assert.match(session.print('tree'), /^!a x=10 y='été' z='d\/a.txt';'d\/b.txt'$/m);
    session.setFile('m.fl', 'let TEN=11\n');
    assert.match(session.step().print('tree'), /x=11/);
    session.close();
});

test('values are passed in and out', () => {
    const session = engine.open({ fps: 10 });
    session.setGlobal('GIVEN', [1, 2.5]);
    session.load('!a x=GIVEN t=time\n').step().step();
    assert.match(session.print('tree'), /x=1;2.5 t=0.1/);
    session.setGlobal('GIVEN', 7);
    assert.match(session.step().print('tree'), /x=7/);
    assert.deepEqual(session.evaluate('1+2'), { text: '3', number: 3 });
    assert.ok(Number.isNaN(session.evaluate("'é'").number));
    assert.throws(() => session.evaluate('1+'), PetriError);
    assert.equal(session.prompt('let q=6\nq*7'), '42\n');
    assert.equal(session.symbolName(session.symbol('cells')), 'cells');
    assert.equal(session.symbolName(0.5), null);
    assert.deepEqual(session.tokens('!a x=1 -- c\n').filter(token => token.start < token.end).map(token => token.kind),
        ['node', 'name', 'operator', 'number', 'comment']);
    const help = session.help();
    assert.ok(help.some(row => row.kind === 'function' && row.name === 'hypot'));
    assert.ok(help.some(row => row.kind === 'name' && row.name === 'q'));
    session.close();
});

test('pointer and keys reach the script', () => {
    const session = opened('!window\n    !pointer state=:p\n    !key name=:space state=:k\n!a x=$(:p) y=$(:k)\n');
    session.step();
    session.pointer(true, 0.25, 0.5, 1).key('space', true);
    stepped(session, 2);
    assert.match(session.print('tree'), /x=0.25;0.5 y=1/);
    assert.throws(() => session.key('no-key', true), /no-key/);
    session.close();
});

test('sessions are independent, and closing them frees all memory', () => {
    const one = opened(DISH), two = opened('!a x=frame\n');
    stepped(one, 3);
    stepped(two, 5);
    assert.equal(one.frame.number, 2);
    assert.equal(two.frame.number, 4);
    one.close();
    two.close();
    const grown = () => engine.memory.wasm.memory.buffer.byteLength;
    const round = () => stepped(opened(DISH), 3).close();
    for (let i = 0; i < 5; i++)
        round();
    const before = grown();
    for (let i = 0; i < 40; i++)
        round();
    assert.equal(grown(), before);
});

// The engine uses the regular expressions of JavaScript for hints.
test('mistakes from other languages have the hints of petri check', () => {
    const rows = read('tests/cli/syntax_hints.txt').split('\n').filter(row => row && !row.startsWith('#'));
    const session = engine.open();
    for (const row of rows) {
        const [wrong, message, hint] = row.split(' ~ '), text = wrong.replace(/\\([nt\\])/g, (_, c) => ({ n: '\n', t: '\t' })[c] ?? c);
        const rendered = session.diagnose(`${text}\n`, 'mistake.fl').map(one => one.rendered).join('');
        assert.ok(rendered.includes(`mistake.fl:${message}`), `${wrong}: ${rendered}`);
        assert.ok(hint === '-' || rendered.split('\n').includes(`    ${hint}`), `${wrong}: ${rendered}`);
    }
    session.close();
    assert.ok(rows.length > 100);
});

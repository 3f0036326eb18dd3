// archive.test.mjs: archives that the native program has written are verified in WebAssembly, and replayed by the page. Skipped without
// the native program. PETRI_WEB is build/web.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { atFrame, folder, opened, options, root, seek, typed } from './browser.mjs';

const petri = join(root, 'build/src/petri'), scratch = mkdtempSync(join(tmpdir(), 'petri-')), live = join(scratch, 'live.petri');
after(() => rmSync(scratch, { recursive: true }));
writeFileSync(join(scratch, 'scale.fl'), 'let scale=3\n');
writeFileSync(join(scratch, 'live.fl'), `%pragma fps 25
import scale from 'scale.fl'
let N=N or 12 -- 1..20
!window size=80;60
    !canvas
        !fill color=0.2;0.5;0.8
            !rect size=40;30
!physics state=:p dimensions=2 time=time
    for i in ..N
        !particle id=i position=scale*i;i*0.5 radius=2 mass=1+i
    !collision
    !random strength=1
    !gravity strength=5
!counter state=:turns rate=0.5
`);
// A session of the prompt: changed parameters, statements and tempo, and frames that were undone.
const tried = spawnSync(petri, ['repl', 'live.fl'], {
    cwd: scratch, encoding: 'utf8',
    input: '.archive live.petri\n.step 30\n.set N 7\nlet k=2\n!counter state=:q rate=k\n.step 20\n.tempo 90\n.step 9\n.back 12\n.step 16\n',
});
const missing = tried.error || !existsSync(live) ? 'petri writes no archives' : false;
const node = { skip: missing }, browser = { ...options, skip: options.skip || missing };
const edits = { skip: missing || (spawnSync('sqlite3', ['-version']).error ? 'missing: sqlite3' : false) };
const { loadEngine } = await import(pathToFileURL(join(folder, 'petri/petri.mjs')));
const engine = await loadEngine('./engine-archives.wasm');

// Returns the bytes of an archive after the SQL statements.
function changed(sql, file = live) {
    const copy = join(scratch, 'changed.petri');
    copyFileSync(file, copy);
    execFileSync('sqlite3', [copy, sql]);
    return readFileSync(copy);
}

// Replays an archive. Returns the number of frames that are the same, the first that differs, and the first problem.
function verify(bytes) {
    const archive = engine.openArchive(bytes), session = engine.open({ archive, keepForces: true });
    const found = { info: archive.info, problem: archive.check(), same: 0, differs: null };
    archive.load(session);
    while (session.frame.number < archive.info.lastFrame && found.differs === null) {
        session.step();
        if (archive.compare(session))
            found.same++;
        else
            found.differs = session.frame.number;
    }
    session.close();
    archive.close();
    return found;
}

test('an archive of the native program is verified in WebAssembly', node, () => {
    const printed = execFileSync(petri, ['archive', 'verify', live], { encoding: 'utf8' });
    const { info, problem, same, differs } = verify(readFileSync(live));
    assert.equal(problem, null);
    assert.equal(info.script, 'live.fl');
    assert.equal(info.lastFrame, 62);
    assert.match(printed, new RegExp(`verified: ${same} of 63 frames.*\ndigest ${info.sha256}`));
    assert.deepEqual([same, differs], [63, null]);
});

test('a replay starts at any keyframe and goes back', node, () => {
    const run = join(scratch, 'run.petri');
    execFileSync(petri, ['run', 'live.fl', '--frames', '60', '--keyframe-every', '20', '--archive', run], { cwd: scratch });
    const archive = engine.openArchive(readFileSync(run)), session = engine.open({ archive });
    archive.load(session, 45);
    assert.equal(session.frame.number, 39);
    const before = session.step().snapshot(), digest = session.digest();
    assert.equal(archive.compare(session), true);
    for (let i = 0; i < 10; i++)
        session.step();
    assert.equal(session.rewind(before).digest(), digest);
    assert.equal(archive.compare(session.step()), true);
    before.free();
    archive.endReplay();
    session.setParameter('N', 3);
    assert.equal(archive.compare(session.step()), false);
    session.close();
    archive.close();
});

test('forged and damaged archives are detected', edits, () => {
    const forged = engine.openArchive(changed('UPDATE digest SET digest = zeroblob(16) WHERE frame = 13'));
    assert.match(forged.check(), /damaged: table keyframe: row \d+ has another SHA-256/);
    assert.throws(() => engine.openArchive(changed('CREATE VIEW v AS SELECT 1')), /its tables are not those of an archive/);
    assert.throws(() => engine.openArchive(changed('PRAGMA user_version = 9')), /newer version of petri: format 9/);
    assert.throws(() => engine.openArchive(changed('PRAGMA application_id = 1')), /not an archive/);
    assert.throws(() => engine.openArchive(changed('PRAGMA journal_mode = WAL')), /write-ahead log, which no archive is/);
    assert.throws(() => engine.openArchive(Buffer.from('no database at all')), /not an archive/);
    const archive = engine.openArchive(changed("UPDATE keyframe SET state = 'x' WHERE frame = -1")), session = engine.open({ archive });
    assert.throws(() => archive.load(session), /cannot load the archive: the archive is damaged: table keyframe: row -1 is not valid/);
});

test('archives are independent of each other, and are freed', node, () => {
    const bytes = readFileSync(live), open = engine.memory.files.files, before = open.size;
    const first = engine.openArchive(bytes), session = engine.open({ archive: first });
    first.load(session);
    const cycle = () => {
        const other = engine.openArchive(bytes);
        assert.equal(other.check(), null);
        other.close();
        assert.equal(first.compare(session.step()), true);
    };
    cycle();
    const size = engine.memory.bytes().length;
    for (let i = 0; i < 50; i++)
        cycle();
    assert.ok(engine.memory.bytes().length <= size + (1 << 20));
    session.close();
    first.close();
    assert.equal(open.size, before);
});

test('the engine without archives says so, and computes the same', async () => {
    const small = await loadEngine(), text = readFileSync(join(root, 'samples/dish.fl'), 'utf8');
    const [one, other] = [small, engine].map(loaded => {
        const session = loaded.open().load(text);
        for (let frame = 0; frame < 20; frame++)
            session.step();
        return session.hash();
    });
    assert.equal(one, other);
    assert.throws(() => small.openArchive(new Uint8Array(0)), /this engine has no archives; load engine-archives\.wasm/);
});

// The page and the command in Node.js have the checks of the native command, so that they find the same first problem. What SQLite says
// about its pages depends on its version.
test('damage is reported as by the native program', node, () => {
    const good = readFileSync(live), file = join(scratch, 'damaged.petri'), problems = new Set();
    const common = text => text?.replace(/ damaged: (?!database|its|reading|table)[^\n]+/, ' damaged: pages');
    const reason = text => text.match(/: (?!cannot)([^\n]*)\n$/)?.[1];
    const first = bytes => {
        let archive;
        try {
            archive = engine.openArchive(bytes);
            return archive.check() ?? undefined;
        } catch (error) {
            return error.message.replace('cannot read the archive: ', '');
        } finally {
            archive?.close();
        }
    };
    const damages = [0, 50, 99, 512, 4096, 5000, good.length - 4096, good.length - 1].map(length => good.subarray(0, length));
    for (let i = 0; i < 40; i++) {
        const bytes = Buffer.from(good), at = i < 20 ? 5 * i : (i * 7919) % good.length;
        bytes[at] ^= 1 << i % 8;
        damages.push(bytes);
    }
    for (const [i, bytes] of damages.entries()) {
        writeFileSync(file, bytes);
        const native = spawnSync(petri, ['archive', 'verify', file], { encoding: 'utf8' }), problem = common(first(bytes));
        assert.equal(problem, native.status === 2 ? common(reason(native.stderr)) : undefined, `damage ${i}: ${native.stderr}`);
        problems.add(problem);
        if (i % 6 === 0) {
            const other = spawnSync('node', [join(folder, 'petri/cli.mjs'), 'archive', 'verify', file], { encoding: 'utf8' });
            assert.deepEqual([common(other.stderr), other.status], [common(native.stderr), native.status], `damage ${i}`);
        }
    }
    assert.ok(problems.size > 6, [...problems].join('; '));
});

test('the command in Node.js records the rows of the native command', edits, () => {
    const rows = [[petri], ['node', join(folder, 'petri/cli.mjs')]].map(([program, ...words], i) => {
        const run = (...args) => execFileSync(program, [...words, ...args], { cwd: scratch, encoding: 'utf8' });
        run('run', 'live.fl', '-D', 'N=5', '--frames', '50', '--keyframe-every', '20', '--archive', 'rows.petri');
        run('archive', 'unpack', 'rows.petri', `unpacked${i}`);
        return [
            execFileSync('sqlite3', [join(scratch, 'rows.petri'), '.dump'], { encoding: 'utf8' }),
            run('archive', 'info', 'rows.petri'), run('archive', 'verify', 'rows.petri'),
            run('run', 'rows.petri', '--from', '30', '--frames', '10', '--print', 'digest'),
            readFileSync(join(scratch, `unpacked${i}/live.fl`), 'utf8'),
        ];
    });
    assert.deepEqual(rows[1], rows[0]);
    assert.ok(rows[0][0].includes('INSERT INTO keyframe VALUES(39,'));
});

const mark = page => page.textContent('#verified');

test('the page replays an archive and shows that its frames are the recorded ones', browser, () => opened('', {
    prepare: page => {
        page.fetched = [];
        page.on('request', request => page.fetched.push(new URL(request.url()).pathname));
    },
    use: async page => {
        assert.ok(!page.fetched.some(path => /archives/.test(path)), 'SQLite is loaded only when it is needed');
        await page.setInputFiles('#file', live);
        await page.waitForFunction(() => /✓.*; 63 of 63 verified/.test(document.getElementById('verified').textContent));
        assert.ok(page.fetched.some(path => /engine-archives\.wasm$/.test(path)));
        await page.click('#run');
        assert.match(await page.textContent('.cm-content'), /import scale from/);
        await seek(page, 31);
        assert.match(await mark(page), /✓ this frame is the recorded one; 63 of 63 verified/);
        assert.equal(await page.inputValue('#parameter-N'), '7', 'the recorded change of the parameter is replayed');
        await seek(page, 5);
        assert.equal(await page.inputValue('#parameter-N'), '12');
        await page.fill('#parameter-N', '4');
        await page.keyboard.press('Enter');
        await page.click('#step');
        await atFrame(page, 6);
        assert.match(await mark(page), /this frame was not recorded; 6 of 63 verified/, 'a change by the user ends the replay');
        await seek(page, 3);
        assert.match(await mark(page), /✓/, 'frames before the change are still the recorded ones');
        await seek(page, 6);
        assert.match(await mark(page), /this frame was not recorded/);
        assert.equal(await page.inputValue('#parameter-N'), '4');
        await typed(page, '!counter state=:c rate=1\n');
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('verified').hidden);
    },
}));

test('the page says which frame of a dropped archive differs, and rejects damaged archives', browser, () => opened('', {
    use: async page => {
        const drop = bytes => page.evaluate(content => {
            const data = new DataTransfer();
            data.items.add(new File([Uint8Array.from(content)], 'a.petri'));
            document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
        }, [...bytes]);
        await drop(readFileSync(live).subarray(0, 3000));
        await page.waitForFunction(() => /the archive is damaged: /.test(document.getElementById('message').textContent));
        // An archive whose sums fit another script: the digests of a run with another rate.
        writeFileSync(join(scratch, 'other.fl'), '!counter state=:c rate=frame if frame<4 else 3\n');
        execFileSync(petri, ['run', 'other.fl', '--frames', '9', '--archive', 'other.petri'], { cwd: scratch });
        await drop(changed('DELETE FROM keyframe WHERE frame > 0; UPDATE digest SET digest = zeroblob(16) WHERE frame = 5',
            join(scratch, 'other.petri')));
        await page.waitForFunction(() => /✗ frame 5 differs from the archive/.test(document.getElementById('verified').textContent));
    },
}));

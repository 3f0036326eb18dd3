// prompt.test.mjs: the prompt of the page prints what `petri repl` prints for the same inputs, as both have the same commands.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { root } from './browser.mjs';
import { Player } from '../../src/web/page/player.mjs';

const folder = `${process.env.PETRI_WEB}/petri`;
const { loadEngine } = await import(`${folder}/petri.mjs`);
const engine = await loadEngine(readFileSync(`${folder}/engine.wasm`));

const SCRIPT = `let SIZE=SIZE or 3 -- 1..9 how large
let LATE = debug($:c) if $:c > 1 and $:c < 1.02
!counter state=:c rate=1
!physics state=:p dimensions=2
    for i in ..4
        !particle id=i position=8*i;i velocity=SIZE;i radius=2 mass=i+1
    !anchor id=:home position=0;0
    !gravity strength=3
    !distance from=:home to=0 strength=5 fixed=4
    !drag strength=0.1
!physics state=:q dimensions=1
    !particle id=9 position=1 velocity=0
    !constant force=2
`;

const INPUTS = [
    '1+1', 'let q=6', 'q*7', "'text'", '.5 + 1', '(1;2)*3', '.step', '.step 3', '.step 2*2', '.step 0', '.step x', '.step 1+',
    '.back', '.back 2', '.back 0', '.goto 12', '.goto 5', '.goto 60', '.goto -2', '.run 0.25', '.run -1', '.run soon',
    '.until frame >= 90', '.until frame < 0 --limit 4', '.until --limit 3 0', '.until', '.until coss(1) --limit 2', '.until 1 --limit x',
    '.state', '.state c', '.state :p;0', '.state :p 2', '.state nothing', '.tree', '.tree drag', '.tree !particle 2', '.tree none',
    '.particles', '.particles p 2', '.particles :q', '.particles none', '.particles all', '.energy', '.energy p', '.energy none',
    '.why 0', '.why 0 all', '.why 1 2', '.why :home', '.why 9', '.why (:p;3)', '.why 77', '.why', '.why 9 all',
    '.goto 70', '.back until changes floor($:c*4)', 'prev($:c)', '.break prev($:c) < 0.5 and $:c >= 0.5', '.back 30', '.step 40', '.break',
    '.b 9', '.s', '.st', '.part 1', '.unb', '.until 1 --limt 2', '.back until false', 'prev(prev(1))', '.goto 90',
    '.watch $:c', '.watch q+1', '.watch', '.watch 1+', '.step 2', '.unwatch q+1', '.unwatch q+1', '.step', '.unwatch', '.step',
    '.move 0', '.move 1 position=3;4', '.particles p', '.move (:p;2) velocity=-1 position=$(:p;1)+1', '.energy', '.move 9 position=4',
    '.step 3', '.particles', '.back 2', '.back 2', '.particles p', '.step 5', '.particles', '.move 77 position=1', '.move :home position=1',
    '.move 1 position=1;2;3', '.move 1 positon=1', '.move 1 position=1/0', '.move 2 velocity=prev($(:p;2;:velocity))', '.step',
    '.parameters', '.set', '.set SIZE', '.set NONE', '.set SIZE 6', '.set SIZE=7', '.step 3', '.particles p 1', '.tempo', '.fps',
    '!drag strength=2', '.step', '.tree drag', '.drop', '.drop everything', '.drop all', 'q*7', 'let SIZE=2', 'func f(x) x*2', 'f(4)',
    'help sin', 'step', 'step 4', 'state', 'quit now', '.stp', '.', '.unknown thing', '.parameters now', '.step 3 4',
    '.help .step', '.help polar', '.help !particle', '.help builtins', '.help nodes', '.help nothing at all', '.help random',
    'x=', '1 +', 'coss(1)', '!nonode', '.reset x', '.back x', '.time .step', '.time 1+', '.time',
];

// Replaces times, and what the command adds to messages.
const comparable = text => text.replace(/^petri: /gm, '').replace(/^-- [\d.e-]+ (s|ms|us|ns)/gm, '-- TIME');

// Returns true if `petri repl` waits for an indented line after an input.
const blocks = input => /^!|^func /.test(input);

// Returns what `petri repl` prints after each input.
function printedByCommand(inputs) {
    const work = mkdtempSync(join(tmpdir(), 'petri-prompt-'));
    try {
        writeFileSync(join(work, 'script.fl'), SCRIPT);
        // The page begins at frame 0. Each marker ends what an input prints.
        const typed = ['.goto 0', ...inputs].flatMap(input => [input, ...blocks(input) ? [''] : [], "'END'"]).join('\n');
        const { stdout } = spawnSync('sh', ['-c', `exec "${join(root, 'build/petri')}" repl script.fl 2>&1`],
            { cwd: work, input: `${typed}\n`, encoding: 'utf8', env: { ...process.env, COLUMNS: '80', LC_ALL: 'C' } });
        const printed = stdout.replace(/^(petri|@\d+|\.\.\.)> .*\n/gm, '').replace(/^\.\.\. \n/gm, '').split(/^'END'\n/m);
        return printed.slice(1, -1);
    } finally {
        rmSync(work, { recursive: true });
    }
}

function printedByPage(inputs) {
    const reported = [], options = { keepForces: true, onDiagnostic: one => reported.push(one) };
    const player = new Player(engine, options, { see() {}, forget() {} });
    player.load(SCRIPT, 'script.fl');
    player.step();
    return inputs.map(input => {
        reported.splice(0);
        const { text } = player.session.execute(`${input}\n`, {
            first: player.first, last: player.lastFrame, step: () => player.step(), goTo: frame => player.seek(frame),
            set: (name, value) => player.set(name, value), move: (...particle) => player.move(...particle), run: () => {}, plot: () => {},
        });
        return [text, reported.map(({ rendered }) => rendered).join('')];
    });
}

test('an empty line repeats the last command that computes frames, and values and breaks last until the next script', () => {
    const player = new Player(engine, { keepForces: true }, { see() {}, forget() {} }), asked = [];
    const execute = input => player.session.execute(`${input}\n`, {
        first: player.first, last: player.lastFrame, step: () => player.step(), goTo: frame => player.seek(frame),
        set: (name, value) => player.set(name, value), run: () => asked.push('run'), plot: text => asked.push(text),
    });
    player.load(SCRIPT, 'script.fl');
    player.step();
    execute('.step 3');
    execute('.particles');
    execute('');
    assert.equal(player.frame, 6);
    assert.equal(execute('6*7').text, '42\n');
    execute('.break frame == 9');
    player.load(SCRIPT, 'script.fl');
    player.step();
    assert.equal(execute('_+1').text, '43\n');
    assert.match(execute('.step 20').text, /^@9 .*\n-- stopped by \.break frame == 9\n$/s);
    assert.match(execute('.save x').text, /^\.save works only in 'petri repl'; in the page, use Export or Copy link\n$/);
    assert.equal(execute('.unbreak').failed, false);
    execute('.run');
    execute('.plot frame*2 10');
    assert.deepEqual(asked, ['run', 'frame*2']);
});

test('each input prints the same in the page and in petri repl', () => {
    const command = printedByCommand(INPUTS), page = printedByPage(INPUTS);
    assert.equal(command.length, INPUTS.length);
    INPUTS.forEach((input, i) => {
        // The page prints diagnostics last.
        const [text, reported] = page[i], lines = all => comparable(all).split('\n').sort();
        assert.deepEqual(lines(text + reported), lines(command[i]), input);
    });
});

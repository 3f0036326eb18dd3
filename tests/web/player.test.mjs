// player.test.mjs: the page's player shows the same frame however it got there: each frame has the digest that a new player computes with
// the recorded changes.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { Player } from '../../src/web/page/player.mjs';

const folder = `${process.env.PETRI_WEB}/petri`;
const { loadEngine } = await import(`${folder}/petri.mjs`);
const engine = await loadEngine(readFileSync(`${folder}/engine.wasm`));

const SCRIPT = force => `let N=N or 3 -- 1..9
let DIM=DIM or 2 -- 1..3
!physics state=:p dimensions=DIM time=beat
    for i in ..N
        !particle id=i position=9*uniform(:a;i)[..DIM] radius=2
    ${force}
    !random strength=4
!counter state=:c rate=N
`;
const FORCES = ['!collision', '!drag', '!gravity ease=1'];
const noWatches = { see() {}, forget() {} };
const opened = (text = SCRIPT(FORCES[0]), changes = []) => {
    const player = new Player(engine, {}, noWatches);
    player.load(text, 't.fl', changes);
    return player;
};

// Returns the digest of a frame that a new player computes without going back.
function expected({ text, changes }, frame) {
    const player = opened(text, changes);
    player.seek(frame);
    const found = [player.session.digest(), ...player.session.parameters.map(parameter => parameter.value)];
    player.history.free();
    player.session.close();
    return found;
}

test('frames are the same after going back and forth and after changes', () => {
    let seed = 1;
    const random = count => (seed = seed * 48271 % 2147483647) % count;
    for (let run = 0; run < 12; run++) {
        const player = opened();
        player.seek(random(40));
        for (let i = 0; i < 40; i++) {
            const kind = random(9), [system] = player.session.systems;
            if (kind === 8 && system)
                player.move(0, random(system.count), ...[0, 1].map(i => (random(3) > i ? Array(system.dimensions).fill(random(9)) : null)));
            else if (kind === 0)
                player.set(random(2) ? 'N' : 'DIM', `${1 + random(3)}`);
            else if (kind === 1)
                player.edit(SCRIPT(FORCES[random(3)]), !random(2));
            else if (kind < 5)
                player.seek(random(player.lastFrame + 1));
            else
                player.seek(player.frame + random(12));
            assert.equal(player.session.frame.number, player.frame);
            const found = [player.session.digest(), ...player.session.parameters.map(parameter => parameter.value)];
            assert.deepEqual(found, expected(player, player.frame), `run ${run}, event ${i}, frame ${player.frame}`);
        }
        player.history.free();
        player.session.close();
    }
});

test('a script with errors changes nothing', () => {
    const player = opened();
    player.seek(30);
    const before = player.session.digest();
    assert.throws(() => player.edit('let x = (', true));
    assert.deepEqual([player.frame, player.lastFrame, player.session.digest()], [30, 30, before]);
});

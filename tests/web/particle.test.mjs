// particle.test.mjs: descriptions of particles for the page: the node of the script, and the forces.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { root } from './browser.mjs';

const folder = `${process.env.PETRI_WEB}/petri`;
const { loadEngine } = await import(`${folder}/petri.mjs`);
const engine = await loadEngine(readFileSync(`${folder}/engine.wasm`));

function stepped(text, { frames = 3, files = {} } = {}) {
    const session = engine.open({ keepForces: true, files });
    session.load(text, 's.fl');
    for (let i = 0; i < frames; i++)
        session.step();
    return session;
}

const placeOf = ({ origin: { file, line, column } }) => [file, line, column];

test('a particle is made by the node that the script executes for it', () => {
    const session = stepped(`import round from 'm.fl'
!physics state=:p dimensions=2 -- !particle id=7
    !anchor id=:middle position=0;0
    for i in ..3
        !particle id=i position=60*i-60;0 radius=20
        !group
            !anchor id=9+i position=0;"!particle id=8"
    round(7)
!physics state=(:q;1) dimensions=2
    for i in ..2
        if i
            !particle id=i
        else
            !particle id=(i;1)
`, { files: { 'm.fl': 'func round(i)\n    !particle id=i position=1;1\n' } });
    const where = (name, id) => placeOf(session.describe({ name, id }));
    assert.deepEqual(where(':p', ':middle'), ['s.fl', 3, 5]);
    assert.deepEqual(where(':p', '2'), ['s.fl', 5, 9]);
    assert.deepEqual(where(':p', '10'), ['s.fl', 7, 13]);
    assert.deepEqual(where(':p', '7'), ['m.fl', 2, 5]);
    assert.deepEqual(where(':q;1', '1'), ['s.fl', 12, 13]);
    assert.deepEqual(where(':q;1', '0;1'), ['s.fl', 14, 13]);
    assert.deepEqual(session.describe({ name: ':p', id: '77' }), {
        origin: undefined, contributions: [], state: [], sum: undefined, note: 'is not in this frame',
    });
});

test('each particle of each sample has a node, and forces as by explain', () => {
    let count = 0;
    const samples = join(root, 'samples'), read = file => readFileSync(join(samples, file), 'utf8');
    const files = Object.fromEntries(readdirSync(join(samples, 'lib')).map(file => [`lib/${file}`, read(`lib/${file}`)]));
    for (const sample of readdirSync(samples).filter(name => name.endsWith('.fl'))) {
        const session = stepped(read(sample), { files });
        session.systems.forEach(({ name, count: particles, steps }, number) => {
            for (let i = 0; i < particles; i += Math.ceil(particles / 5)) {
                const found = session.describe({ name, id: session.particleId(number, i) }), { file, line, column, kind } = found.origin;
                const text = file === 's.fl' ? read(sample) : files[file];
                assert.ok([...text.split('\n')[line - 1]].slice(column - 1).join('').startsWith(`!${kind}`), `${sample}: ${name};${i}`);
                const { contributions, sum } = steps ? session.explain(number, i) : { contributions: [] };
                assert.deepEqual([found.contributions, found.sum], [contributions, sum], `${sample}: ${name};${i}`);
                count++;
            }
        });
        session.close();
    }
    assert.ok(count > 50);
});

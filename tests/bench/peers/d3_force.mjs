// d3_force.mjs: prints the milliseconds of a tick of d3-force-3d with 100 000 nodes that repel each other, theta 0.9.
//
//   cd $(mktemp -d) && npm install d3-force-3d && NODE_PATH=$PWD/node_modules node PATH/d3_force.mjs [NODES]
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { join } from 'node:path';

const folder = process.env.NODE_PATH ?? join(process.cwd(), 'node_modules');
const entry = createRequire(import.meta.url).resolve(join(folder, 'd3-force-3d/src/index.js'));
const { forceSimulation, forceManyBody } = await import(pathToFileURL(entry).href);

const count = Number(process.argv[2] ?? 100000);
let state = 88172645463325252n;

// Returns the next number of a xorshift generator, from 0 to 1.
function uniform() {
    state ^= (state << 13n) & 0xffffffffffffffffn;
    state ^= state >> 7n;
    state ^= (state << 17n) & 0xffffffffffffffffn;
    return Number(state >> 11n) / 2 ** 53;
}

const nodes = Array.from({ length: count }, () => ({ x: uniform(), y: uniform(), z: uniform() }));
const simulation = forceSimulation(nodes, 3).force('charge', forceManyBody().theta(0.9).strength(-1e-9)).stop();
let best = Infinity;
for (let round = 0; round < 4; round++) {
    const start = performance.now();
    simulation.tick();
    best = Math.min(best, performance.now() - start);
}
console.log(best.toFixed(0));

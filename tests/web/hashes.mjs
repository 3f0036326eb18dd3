// hashes.mjs ENGINE CORPORA EXPECTED: compares the results of the conformance scripts in WebAssembly with the stored results of all other
// builds. tests/hashes/hashes.sh describes the format.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { loadEngine } from '../../src/web/engine/petri.mjs';

const [, , wasm, corpora, expected] = process.argv;
const engine = await loadEngine(readFileSync(wasm));

// Returns the options in the first line of a golden.
function options(line) {
    const words = line.replace(/^# run /, '').trim().split(/ +/);
    const read = { frames: 1, every: 1, fps: 0, definitions: [] };
    for (let i = 0; i < words.length; i += 2) {
        const value = words[i + 1].replaceAll("'", '').replaceAll('"', '');
        if (words[i] === '-D')
            read.definitions.push(value);
        else if (words[i] === '--print')
            continue;
        else if (words[i].slice(2) in read)
            read[words[i].slice(2)] = Number(value);
        else
            throw new Error(`unknown option: ${words[i]}`);
    }
    return read;
}

function filesOf(folder) {
    const files = {};
    for (const entry of readdirSync(folder, { withFileTypes: true, recursive: true }))
        if (entry.isFile() && !entry.name.endsWith('.golden')) {
            const path = join(entry.path ?? entry.parentPath, entry.name);
            files[path.slice(folder.length + 1)] = readFileSync(path);
        }
    return files;
}

function hashOf(files, name, { frames, every, fps, definitions }) {
    const session = engine.open({ fps, files }), hash = createHash('sha256');
    definitions.forEach(definition => session.define(definition));
    session.load(files[name], name);
    for (let frame = 0; frame < frames; frame++) {
        session.step();
        if (frame % every === 0)
            hash.update(session.print('tree', 'log', 'hash', 'digest'));
        else
            continue;
    }
    session.close();
    return hash.digest('hex').slice(0, 16);
}

let count = 0;
const found = new Set();
for (const folder of readdirSync(corpora, { withFileTypes: true }).filter(entry => entry.isDirectory())) {
    const path = join(corpora, folder.name), files = filesOf(path);
    for (const golden of readdirSync(path).filter(name => name.endsWith('.golden'))) {
        const name = golden.replace(/golden$/, 'fl');
        const [line] = readFileSync(join(path, golden), 'utf8').split('\n');
        let came;
        try {
            came = hashOf(files, name, options(line));
        } catch (error) {
            came = error.message;
        }
        found.add(`${folder.name}/${name} ${came}`);
        count++;
    }
}
const wanted = readFileSync(expected, 'utf8').trim().split('\n');
const differing = wanted.filter(line => !found.has(line));
for (const line of differing) {
    const [name] = line.split(' ');
    console.log([...found].find(other => other.startsWith(`${name} `)) ?? `${name} was not run`);
}
console.log(`hashes in WebAssembly: ${count} scripts, ${differing.length} differ`);
process.exit(differing.length === 0 && count === wanted.length ? 0 : 1);

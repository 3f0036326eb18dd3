// offline_files.mjs OUTPUT: writes OUTPUT/offline.js with the hashes of all files in OUTPUT that work offline.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { engineFile, hasSimd } from '../engine/simd.mjs';

const [, , output] = process.argv;
// The only files of the npm package that pages load.
const ENGINES = ['petri/engine.wasm', 'petri/engine-scalar.wasm', 'petri/engine-archives.wasm'];
const hash = bytes => createHash('sha256').update(bytes).digest('base64');

const paths = readdirSync(output, { recursive: true, withFileTypes: true }).filter(entry => entry.isFile())
    .map(entry => relative(output, join(entry.parentPath ?? entry.path, entry.name)).replaceAll('\\', '/'))
    .filter(path => path !== 'offline.js' && !/\.(log|txt)$/.test(path) && (!path.startsWith('petri/') || ENGINES.includes(path))).sort();
const files = JSON.stringify(Object.fromEntries(paths.map(path => [path, hash(readFileSync(join(output, path)))])), null, 0);
writeFileSync(join(output, 'offline.js'), readFileSync(join(dirname(fileURLToPath(import.meta.url)), 'offline.js'), 'utf8')
    .replace("VERSION = ''", `VERSION = '${hash(files).slice(0, 8)}'`).replace('FILES = {}', () => `FILES = ${files}`)
    .replace('engineFile = null', () => `hasSimd = ${hasSimd}, engineFile = ${engineFile}`));

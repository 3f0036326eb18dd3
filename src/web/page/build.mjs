// build.mjs OUTPUT SAMPLES: bundles the page with esbuild.
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { packagesOf, writeLicences } from '../../packaging/licences.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const [, , output, samples] = process.argv;
const OPTIONS = {
    external: ['node:fs/promises', './exports.js*', './grid.js*'], bundle: true, minify: true, target: 'es2022', logLevel: 'warning',
};
const inputs = {};
// The addresses of files that are loaded later, with their hashes, so that a page never loads those of another version (offline.js).
const define = {};

async function bundle(entryPoints) {
    const entries = Object.entries(entryPoints).map(([name, file]) => [name, join(here, file)]);
    const { metafile } = await build({
        ...OPTIONS, entryPoints: Object.fromEntries(entries), outdir: output, format: 'esm', loader: { '.css': 'text' },
        metafile: true, define,
    });
    Object.assign(inputs, metafile.inputs);
    for (const [name] of entries) {
        const hash = createHash('sha256').update(readFileSync(join(output, `${name}.js`))).digest('base64').slice(0, 8);
        define[`${name.replace('-', '_').toUpperCase()}_FILE`] = JSON.stringify(`./${name}.js?v=${encodeURIComponent(hash)}`);
    }
}

await bundle({ exports: 'exports.mjs', cells: 'cells.mjs' });
await bundle({ worker: 'worker.mjs' });
await bundle({ grid: 'grid.mjs' });
await bundle({ page: 'main.mjs', start: 'preload.mjs', 'petri-dish': 'embed.mjs' });
writeLicences(join(output, 'third-party-licences.txt'), packagesOf({ inputs }));
for (const name of ['index.html', 'style.css', 'icon.svg', 'manifest.webmanifest'])
    copyFileSync(join(here, name), join(output, name));
const files = folder => readdirSync(join(samples, folder)).filter(name => name.endsWith('.fl'))
    .map(name => [`${folder}/${name}`, readFileSync(join(samples, folder, name), 'utf8')]);
const texts = Object.fromEntries(readdirSync(samples).filter(name => name.endsWith('.fl')).sort()
    .map(name => [name, readFileSync(join(samples, name), 'utf8')]));
// The page's first script names no commands of the terminal.
texts['dish.fl'] = texts['dish.fl'].replace(/^(-- .*?:).*\n/, '$1 change a number below.\n').replace(/ `petri run -D .*/, '');
// The pictures of the manual, which the gallery shows at once (src/web/site/text.mjs names them).
const pictures = Object.fromEntries(Object.keys(texts).flatMap(name => ['pictures/', ''].map(folder => `${folder}${name.slice(0, -3)}.png`)
    .filter(file => existsSync(join(samples, file))).slice(0, 1)
    .map(file => [name, `manual/pictures/samples-${file.replaceAll('/', '-')}`])));
writeFileSync(join(output, 'samples.json'), JSON.stringify({ scripts: texts, files: Object.fromEntries(files('lib')), pictures }));

// The page of `petri link --html`, which contains everything but the script. `petri link` replaces the text of #petri-data.
const { outputFiles: [code, worker] } = await build({
    ...OPTIONS, entryPoints: [join(here, 'standalone.mjs'), join(here, 'worker.mjs')], outdir: output, format: 'iife', write: false,
    logOverride: { 'empty-import-meta': 'silent' },
});
const packed = bytes => gzipSync(bytes, { level: 9 }).toString('base64');
const filled = [
    [/(id="petri-engine">)/, packed(readFileSync(join(output, 'petri/engine.wasm')))],
    [/(id="petri-worker">)/, packed(worker.contents)],
    [/(id="petri-code">)/, code.text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--')],
    [/()\/\*style\*\//, readFileSync(join(here, 'embed.css'), 'utf8')],
].reduce((html, [place, text]) => html.replace(place, (_, tag) => tag + text), readFileSync(join(here, 'standalone.html'), 'utf8'));
writeFileSync(join(output, 'standalone.html'), filled);

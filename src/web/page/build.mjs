// build.mjs OUTPUT SAMPLES: bundles the page with esbuild.
import { copyFileSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { packagesOf, writeLicences } from '../../packaging/licences.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const [, , output, samples] = process.argv;
const LATER = ['node:fs/promises', './exports.js']; // modules that are loaded when they are needed
const { metafile } = await build({
    entryPoints: {
        page: join(here, 'main.mjs'), start: join(here, 'preload.mjs'), worker: join(here, 'worker.mjs'),
        'petri-dish': join(here, 'embed.mjs'), exports: join(here, 'exports.mjs'),
    },
    outdir: output, bundle: true, minify: true, format: 'esm', target: 'es2022', loader: { '.css': 'text' },
    external: LATER, logLevel: 'warning', metafile: true,
});
writeLicences(join(output, 'third-party-licences.txt'), packagesOf(metafile));
for (const name of ['index.html', 'style.css', 'offline.js'])
    copyFileSync(join(here, name), join(output, name));
const files = folder => readdirSync(join(samples, folder)).filter(name => name.endsWith('.fl'))
    .map(name => [`${folder}/${name}`, readFileSync(join(samples, folder, name), 'utf8')]);
const texts = Object.fromEntries(readdirSync(samples).filter(name => name.endsWith('.fl')).sort()
    .map(name => [name, readFileSync(join(samples, name), 'utf8')]));
// The page's first script names no commands of the terminal.
texts['dish.fl'] = texts['dish.fl'].replace(/^(-- .*?:).*\n/, '$1 change a number below.\n').replace(/ `petri run -D .*/, '');
writeFileSync(join(output, 'samples.json'), JSON.stringify({ scripts: texts, files: Object.fromEntries(files('lib')) }));

// The page of `petri link --html`, which contains everything but the script. `petri link` replaces the text of #petri-data.
const { outputFiles: [code, worker] } = await build({
    entryPoints: [join(here, 'standalone.mjs'), join(here, 'worker.mjs')], outdir: output, bundle: true, minify: true, format: 'iife',
    target: 'es2022', write: false, logLevel: 'warning', logOverride: { 'empty-import-meta': 'silent' }, external: LATER,
});
const packed = bytes => gzipSync(bytes, { level: 9 }).toString('base64');
const filled = [
    [/(id="petri-engine">)/, packed(readFileSync(join(output, 'petri/engine.wasm')))],
    [/(id="petri-worker">)/, packed(worker.contents)],
    [/(id="petri-code">)/, code.text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--')],
    [/()\/\*style\*\//, readFileSync(join(here, 'embed.css'), 'utf8')],
].reduce((html, [place, text]) => html.replace(place, (_, tag) => tag + text), readFileSync(join(here, 'standalone.html'), 'utf8'));
writeFileSync(join(output, 'standalone.html'), filled);

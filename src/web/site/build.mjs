// build.mjs ROOT OUTPUT TABLES: builds the manual in OUTPUT/manual from the documentation in ROOT. OUTPUT contains the engine (petri/) and
// <petri-dish>; TABLES is the output of `petri-manual tables.json`.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { packagesOf, writeLicences } from '../../packaging/licences.mjs';
import { build } from '../page/node_modules/esbuild/lib/main.js';
import { loadEngine } from '../engine/petri.mjs';
import { Examples } from './examples.mjs';
import { GENERATED } from './generated.mjs';
import { GROUPS, PAGES, cut } from './pages.mjs';
import { Text, escape, placesOf } from './text.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const [, , root, folder, tables] = process.argv.map((word, i) => i === 2 || i === 3 ? resolve(word) : word);
const output = join(folder, 'manual');
rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
const engine = await loadEngine(readFileSync(join(folder, 'petri/engine.wasm')));
const site = {
    root, output, tables: JSON.parse(readFileSync(tables, 'utf8')), places: placesOf(root), examples: new Examples(engine, root, output),
};
site.text = new Text(site);

// Returns the named code blocks of a page: the modules that scripts on the page import or include.
const modulesOf = markdown => Object.fromEntries([...markdown.matchAll(/^```flitter (\S+\.fl)\n(.*?)^```/gms)]
    .map(([, name, text]) => [name, text])
    .filter(([name]) => markdown.includes(`"${name}"`)));

// Returns the text of a page with its replacements. A space in an expression also matches the end of a line.
function replaced(markdown, { name, replace = [] }) {
    for (const [{ source, flags }, text] of replace) {
        const expression = new RegExp(source.replaceAll(' ', '\\s+'), flags);
        if (!expression.test(markdown))
            throw new Error(`${name}: nothing matches ${expression}`);
        markdown = markdown.replace(expression, text);
    }
    return markdown;
}

const list = items => `<ul>\n${items.map(item => `<li>${item}</li>`).join('\n')}\n</ul>`;

const nav = current => GROUPS.map(([title, pages]) => `<h2>${title}</h2>\n${list(pages.map(page =>
    `<a href="${page.name}.html"${page.name === current ? ' aria-current="page"' : ''}>${escape(page.title)}</a>`))}\n`).join('');

const contents = sections => sections.length > 1
    ? `<h2>On this page</h2>\n${list(sections.map(one => `<a href="#${one.id}">${escape(one.title)}</a>`))}` : '';

const html = (page, title, body, sections) => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(title)} · petri</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="site.css">
<script src="site.js" defer></script>
<script type="module" src="../petri-dish.js"></script>
<script type="module" src="try.js"></script>
</head>
<body>
<a class="skip" href="#text">Skip to content</a>
<header>
<a href="index.html"><strong>petri</strong> manual</a>
<form role="search"><input id="find" type="search" placeholder="Search ( / )" aria-label="Search the manual" autocomplete="off">
<div id="found" role="region" aria-label="Search results" aria-live="polite" hidden></div></form>
<a href="../index.html">Playground</a>
<a href="../tour/index.html">Tour</a>
<button id="theme" aria-label="Switch theme">◐</button>
</header>
<div id="columns">
<nav aria-label="Pages"><details open><summary>Pages</summary>
${nav(page)}</details></nav>
<main id="text">
<p id="served" hidden>This page was opened from a file, so the browser does not allow it to run the examples.
To run them, start <code>./dev web --serve</code> and open the address that it prints.</p>
${body}</main>
<nav id="sections" aria-label="On this page">${contents(sections)}</nav>
</div>
</body>
</html>
`;

// Returns a map from each everyday word to the words that the manual uses.
function synonymsOf({ nodes, everyday }) {
    const map = new Map();
    for (const { words, names } of [...nodes.map(({ name, synonyms }) => ({ words: synonyms, names: name })), ...everyday])
        for (const word of words.split(' ').filter(Boolean))
            map.set(word, new Set([...map.get(word) ?? [], ...names.split(' ')].filter(name => name !== word)));
    return Object.fromEntries([...map].map(([word, names]) => [word, [...names]]));
}

// The search index: pages as [address, title], sections as [index of the page, title, id, text], and synonyms.
const index = { pages: [], sections: [], synonyms: synonymsOf(site.tables) };
const words = text => text.replaceAll(/<\/?(span|code|a|em|strong)\b[^>]*>/g, '').replaceAll(/<[^>]*>/g, ' ')
    .replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&quot;', '"').replaceAll('&amp;', '&').replaceAll(/\s+/g, ' ').trim();

// Adds a page to the index. A section contains the text up to the next heading. Every page can be found by its title.
function addToIndex(page, body, sections) {
    const number = index.pages.push([`${page.name}.html`, page.title]) - 1;
    index.sections.push([number, page.title, 'text', page.about]);
    const pieces = new Map([...body.matchAll(/<h[1-4] id="([^"]*)">.*?<\/h[1-4]>(.*?)(?=<h[1-4] id=|$)/gs)]
        .map(([, id, text]) => [id, text]));
    for (const { title, id, text } of sections)
        index.sections.push([number, title, id, words(text || pieces.get(id)?.replaceAll(/<petri-dish.*?<\/petri-dish>/gs, ' ') || '')]);
}

for (const page of PAGES) {
    const env = { page: page.name, names: new Set(['text', 'find', 'found', 'theme', 'columns', 'sections', 'served']), sections: [] };
    let body = '';
    for (const [file, from, to] of page.parts ?? []) {
        const markdown = replaced(cut(readFileSync(join(root, file), 'utf8'), from, to), page);
        site.examples.begin(modulesOf(markdown), page.autoplay);
        body += site.text.render(markdown, Object.assign(env, { file }));
    }
    if (!/^<h1/.test(body))
        body = `<h1 id="top">${escape(page.title)}</h1>\n${body}`;
    body += page.made ? GENERATED[page.made](site, env) : '';
    writeFileSync(join(output, `${page.name}.html`), html(page.name, page.title, body, env.sections.filter(({ level }) => level === 2)));
    addToIndex(page, body, env.sections);
}

const cards = GROUPS.map(([title, pages]) => `<h2>${title}</h2>\n<ul class="cards">\n${pages.map(({ name, title: its, about }) =>
    `<li><a href="${name}.html">${escape(its)}</a><br>${escape(about)}</li>`).join('\n')}\n</ul>\n`).join('');
writeFileSync(join(output, 'index.html'), html('index', 'The manual', `<h1>The petri manual</h1>
<p>petri ${escape(site.tables.title)}. It gives bit-identical results on every machine. Your browser computes the dish below and all
examples on these pages. Change a number or move a slider to see the effect. The
<a href="../tour/index.html">tour</a> begins with one particle and ends with a film.</p>
<petri-dish src="dish.fl" controls autoplay label="A dish of drops, and a spoon that stirs them">${
    site.text.image('pictures/dish.png', 'A dish of drops', { file: 'samples/README.md' })}</petri-dish>
${cards}`, []));
writeFileSync(join(output, 'index.js'), `globalThis.PETRI_INDEX = ${JSON.stringify(index)};\n`);
writeFileSync(join(output, 'examples.json'), JSON.stringify(site.examples.all));
for (const name of ['site.css', 'site.js'])
    copyFileSync(join(here, name), join(output, name));
const bundle = (name, format) => build({
    entryPoints: [join(here, `${name}.mjs`)], outfile: join(output, `${name}.js`), bundle: true, minify: true, format,
    external: ['node:fs/promises'], legalComments: 'inline', logLevel: 'warning', metafile: true,
});
const bundles = [await bundle('try', 'esm'), await bundle('search', 'iife')];
const inputs = Object.assign({}, ...bundles.map(({ metafile }) => metafile.inputs));
writeLicences(join(output, 'third-party-licences.txt'), packagesOf({ inputs }));
const count = kind => site.examples.all.filter(one => one.kind === kind || (kind === 'text' && one.kind !== 'dish')).length;
console.log(`${PAGES.length + 1} pages, ${count('dish')} dishes, ${count('text')} other runnable examples`);

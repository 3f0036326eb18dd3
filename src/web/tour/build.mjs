// build.mjs OUTPUT: builds the tour in OUTPUT/tour: a page for each lesson.
import { copyFileSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from '../page/node_modules/esbuild/lib/main.js';
import { inlineCode } from '../site/text.mjs';
import { LESSONS } from './lessons.mjs';

const MarkdownIt = createRequire(new URL('../site/build.mjs', import.meta.url))('markdown-it');

const here = dirname(fileURLToPath(import.meta.url)), output = join(process.argv[2], 'tour'), md = new MarkdownIt({ html: false });
md.renderer.rules.code_inline = (tokens, i) => inlineCode(tokens[i].content);
const escape = text => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
const fileOf = number => number === 0 ? 'index.html' : `${LESSONS[number].name}.html`;
const contents = current => LESSONS.map(({ title, name }, i) =>
    `<li data-lesson="${name}"><a href="${fileOf(i)}"${i === current ? ' aria-current="page"' : ''}>${escape(title)}</a></li>`).join('\n');

const FILM = ' <button id="film">Make the film</button> <progress id="film-progress" aria-label="Progress" hidden></progress>';

function html({ title, task, prose, name, frame, check, tree, film, start, solution }, number) {
    const last = LESSONS.length - 1, data = { name, frame, check, tree, film, start, solution };
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(title)} · petri tour</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="tour.css">
</head>
<body>
<header>
<a href="../index.html"><strong>petri</strong> playground</a>
<a href="../manual/index.html">Manual</a>
<button id="theme" aria-label="Switch theme">◐</button>
</header>
<main>
<article>
<h1>${escape(title)}</h1>
${md.render(prose)}
<section id="task" aria-labelledby="task-title"><h2 id="task-title">Your task</h2>
<p>${md.renderInline(task)}</p>
<p id="result" role="status"></p>
<p><button id="again">Start again</button> <button id="solve">Show a solution</button>${film ? FILM : ''}</p></section>
<nav aria-label="Lessons">
<p id="steps">${number > 0 ? `<a id="back" href="${fileOf(number - 1)}" rel="prev">← Back</a>` : '<span></span>'}
<span>${number + 1} of ${last + 1}</span>
<a id="next" href="${number < last ? fileOf(number + 1) : '../index.html'}">${number < last ? 'Next' : 'Playground'} →</a></p>
<details><summary>All lessons</summary><ol id="lessons">
${contents(number)}
</ol></details></nav>
</article>
<section id="code" aria-label="Script and picture">
<div id="editor"></div>
<ul id="problems" aria-label="Problems" aria-live="polite"></ul>
<div id="frame"><canvas id="picture" tabindex="0" aria-label="The picture of the script"></canvas></div>
<p id="message" role="status"></p>
<div id="below"></div>
</section>
</main>
<noscript>The tour needs JavaScript. Your scripts run in the browser and are not uploaded.</noscript>
<script type="application/json" id="lesson">${JSON.stringify(data).replaceAll('<', '\\u003c')}</script>
<script type="module" src="tour.js"></script>
</body>
</html>
`;
}

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
LESSONS.forEach((lesson, number) => writeFileSync(join(output, fileOf(number)), html(lesson, number)));
copyFileSync(join(here, 'tour.css'), join(output, 'tour.css'));
await build({
    entryPoints: [join(here, 'tour.mjs')], outfile: join(output, 'tour.js'), bundle: true, minify: true, format: 'esm', target: 'es2022',
    nodePaths: [join(here, '../page/node_modules')], legalComments: 'none', logLevel: 'warning',
});
console.log(`${LESSONS.length} lessons`);

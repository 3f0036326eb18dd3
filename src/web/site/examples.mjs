// examples.mjs: runnable examples on the pages of the manual. Examples that draw something become a <petri-dish>; others become text with
// their result (try.mjs). The results are computed here with the same engine.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { drawPicture } from '../engine/drawing.mjs';
import { escape } from './text.mjs';

// A stub for the Canvas 2D context and other browser objects that drawing needs; it draws nothing.
const nothing = new Proxy(function () {}, {
    get: (_, name) => name === 'canvas' ? { width: 1, height: 1 } : name === Symbol.toPrimitive ? () => 0 : nothing,
    apply: () => nothing, construct: () => nothing, set: () => true,
});
for (const name of ['Path2D', 'OffscreenCanvas', 'DOMMatrix', 'ImageData'])
    globalThis[name] ??= nothing;

export class Examples {
    constructor(engine, root, output) {
        Object.assign(this, { engine, root, output, all: [], files: {} });
        const folder = join(root, 'src/web/site/examples');
        this.nodes = new Map(readdirSync(folder).filter(name => name.endsWith('.fl'))
            .map(name => [name.slice(0, -3), readFileSync(join(folder, name), 'utf8')]));
    }

    // Begins a page. `files` contains its modules by file name. If `autoplay` is true, the first dish runs when it comes into view.
    begin(files, autoplay = false) {
        Object.assign(this, { files, autoplay });
    }

    // Returns 'dish' if the script draws something that browsers support, 'text' if it only loads, and 'none' if it has errors.
    kindOf(text, files = this.files) {
        const session = this.engine.open({ files });
        try {
            session.load(text);
            for (let i = 0; i < 3; i++)
                session.step();
            if (!session.drawable)
                return session.reported?.some(({ level }) => level === 'error') ? 'none' : 'text';
            const picture = session.displayList();
            // Browsers draw unsupported nodes with WebGL, which is not available here. Other unsupported parts are never drawn.
            const left = picture ? drawPicture(nothing, picture.numbers, { image: name => name in files ? nothing : null }) : [' '];
            return left.every(what => /^\w+$/.test(what)) ? 'dish' : 'text';
        } catch {
            return 'none';
        } finally {
            session.close();
        }
    }

    coloured(text) {
        const session = this.engine.open(), bytes = Buffer.from(text);
        let html = '', at = 0;
        for (const { kind, start, end } of session.tokens(text)) {
            if (end === start)
                continue;
            const piece = escape(bytes.subarray(start, end).toString());
            html += escape(bytes.subarray(at, start).toString())
                + (kind === 'name' || kind === 'operator' ? piece : `<span class="${kind}">${piece}</span>`);
            at = end;
        }
        session.close();
        return html + escape(bytes.subarray(at).toString());
    }

    plain(text) {
        return `<pre tabindex="0"><code>${escape(text)}</code></pre>\n`;
    }

    code(text) {
        return `<pre tabindex="0" class="script"><code>${this.coloured(text)}</code></pre>\n`;
    }

    // Returns a dish with an editable script. Without JavaScript, only the script is shown.
    dish(text, label, env, files = []) {
        this.all.push({ page: env.page, kind: 'dish', text, files: {} });
        const given = files.length ? ` files="${escape(files.join(' '))}"` : '';
        const plays = this.autoplay ? ' autoplay' : '';
        this.autoplay = false;
        return `<petri-dish controls editor${plays}${given} label="${escape(label)}">`
            + `<pre tabindex="0" class="script">${this.coloured(text)}</pre></petri-dish>\n`;
    }

    try(kind, frame, text, result, env) {
        const files = kind === 'eval' ? {} : this.files;
        this.all.push({ page: env.page, kind, frame, text, result, files });
        const given = Object.keys(files).length ? ` data-files="${escape(JSON.stringify(files))}"` : '';
        return `<div class="try" data-kind="${kind}" data-frame="${frame}"${given}>${this.code(text)}`
            + `<pre tabindex="0" class="result"><code>${escape(result)}</code></pre></div>\n`;
    }

    fence({ info, content }, next, env) {
        const [kind, name = ''] = info.trim().split(/\s+/);
        const label = `Picture of the example: ${env.sections.at(-1)?.title ?? env.page}`;
        if (kind === 'formula')
            return `<pre tabindex="0" class="formula"><code>${escape(content)}</code></pre>\n`;
        if (kind === 'flitter-eval')
            return this.evaluations(content, env);
        if (kind === 'tree' || kind === 'state')
            return ''; // the output is already shown below its script
        if (kind !== 'flitter')
            return this.plain(content);
        if (name.endsWith('.png'))
            return this.code(content); // an excerpt of the script that draws the picture above
        const expected = next?.type === 'fence' ? next.info.trim().split(/\s+/) : [];
        if (expected[0] === 'tree' && next.content.trim() === 'error')
            return this.code(content);
        if (expected[0] === 'tree' || expected[0] === 'state')
            return this.try(expected[0], Number(expected[1] ?? 0), content, next.content, env);
        return this.kindOf(content) === 'dish' ? this.dish(content, label, env) : this.code(content);
    }

    // Returns the HTML of a block with lines `EXPRESSION => RESULT`.
    evaluations(content, env) {
        const lines = content.trimEnd().split('\n').map(line => line.split(/ => (?!.* => )/));
        const texts = lines.map(([text]) => `${text.trimEnd()}\n`), results = lines.map(([, result = '']) => `${result}\n`);
        return this.try('eval', 0, texts.join(''), results.join(''), env);
    }

    // Returns the images and models that a script names and that exist in its folder.
    beside(file, text) {
        const folder = dirname(join(this.root, file));
        const names = new Set([...text.matchAll(/(["'])(\w[\w/]*\.(?:png|jpg|obj|stl))\1/g)].map(([, , name]) => name));
        return [...names].filter(name => existsSync(join(folder, name))).map(name => [name, join(folder, name)]);
    }

    // Returns the HTML of a dish with the script of a picture, to be shown below the picture.
    behind(file, env) {
        const text = readFileSync(join(this.root, file), 'utf8'), files = this.beside(file, text);
        if (this.kindOf(text, Object.fromEntries(files.map(([name, from]) => [name, readFileSync(from)]))) !== 'dish')
            return '';
        for (const [name, from] of files) {
            mkdirSync(join(this.output, dirname(name)), { recursive: true });
            copyFileSync(from, join(this.output, name));
        }
        const dish = this.dish(text, `The picture of ${basename(file)}`, env, files.map(([name]) => name));
        return `<details><summary>Run ${basename(file)}</summary>\n${dish}</details>\n`;
    }

    // Returns the HTML of the dish below the heading of a physics node.
    under(title, env) {
        const name = title.match(/^!(\w+)$/)?.[1];
        return env.page === 'physics' && this.nodes.has(name)
            ? this.dish(this.nodes.get(name), `!${name}, with parameters to change`, env) : '';
    }
}

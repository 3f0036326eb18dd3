// text.mjs: converts Markdown to HTML with heading ids, links between pages, copied images and runnable examples.
import { copyFileSync, existsSync, mkdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import MarkdownIt from 'markdown-it';
import { PAGES, cut, slug } from './pages.mjs';

export const escape = text => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

// Returns code within a line. Firefox would break lines after the exclamation mark of a node.
export const inlineCode = text => `<code${/^!\w+$/.test(text) ? ' class="whole"' : ''}>${escape(text)}</code>`;

// Returns an id that is not used on the page yet.
export function freeName(id, { names }) {
    let name = id || 'section';
    for (let n = 1; names.has(name); n++)
        name = `${id}-${n}`;
    names.add(name);
    return name;
}

// Returns a map from each heading, `FILE#SLUG`, and from the start of each file, `FILE#`, to its address in the manual.
export function placesOf(root) {
    const places = new Map(), md = new MarkdownIt();
    for (const { name, parts = [] } of PAGES)
        for (const [file, from, to] of parts) {
            const tokens = md.parse(cut(readFileSync(join(root, file), 'utf8'), from, to), {});
            if (!places.has(`${file}#`))
                places.set(`${file}#`, `${name}.html`);
            tokens.forEach((token, i) => token.type === 'heading_open'
                && places.set(`${file}#${slug(tokens[i + 1].content)}`, `${name}.html#${slug(tokens[i + 1].content)}`));
        }
    return places;
}

// Returns the width and height of a PNG or GIF file.
function sizeOf(bytes) {
    return bytes[0] === 0x89 ? [bytes.readUInt32BE(16), bytes.readUInt32BE(20)] : [bytes.readUInt16LE(6), bytes.readUInt16LE(8)];
}

export class Text {
    // site: root, output, places, examples (examples.mjs).
    constructor(site) {
        this.site = site;
        this.md = new MarkdownIt({ html: false });
        const { rules } = this.md.renderer, own = this;
        rules.heading_open = (tokens, i, _, env) => {
            const text = own.plain(tokens[i + 1]), id = freeName(slug(tokens[i + 1].content), env);
            env.sections.push({ level: Number(tokens[i].tag[1]), title: text, id, text: '' });
            return `<${tokens[i].tag} id="${id}">`;
        };
        rules.heading_close = (tokens, i, _, env) => {
            const { id, title } = env.sections.at(-1);
            return ` <a class="here" href="#${id}" aria-label="Link to ${escape(title)}">#</a></${tokens[i].tag}>\n`
                + own.site.examples.under(title, env);
        };
        rules.image = (tokens, i, _, env) => own.image(tokens[i].attrGet('src'), own.plain(tokens[i]), env);
        rules.link_open = (tokens, i, _, env) => {
            const target = own.target(tokens[i].attrGet('href'), env);
            const script = normalize(join(dirname(env.file), tokens[i].attrGet('href')));
            if (/^tests\/pictures\/.*\.fl$/.test(script))
                env.behind.push(script);
            env.open.push(target !== null);
            return target === null ? '' : `<a href="${escape(target)}">`;
        };
        rules.link_close = (tokens, i, _, env) => env.open.pop() ? '</a>' : '';
        rules.table_open = () => '<div class="table" tabindex="0" role="group" aria-label="Table"><table>\n';
        rules.table_close = (tokens, i, _, env) => `</table></div>\n${own.behind(env)}`;
        rules.paragraph_close = (tokens, i, _, env) => tokens[i].hidden ? '' : `</p>\n${own.behind(env)}`;
        // A header cell without text becomes a normal cell.
        rules.th_open = (tokens, i) => tokens[i + 1].content.trim() ? '<th>' : '<td>';
        rules.th_close = (tokens, i) => tokens[i - 1].content.trim() ? '</th>' : '</td>';
        rules.code_inline = (tokens, i) => inlineCode(tokens[i].content);
        rules.fence = (tokens, i, _, env) => own.site.examples.fence(tokens[i], tokens[i + 1], env);
        rules.code_block = (tokens, i) => own.site.examples.plain(tokens[i].content);
    }

    plain(inline) {
        return (inline.children ?? []).map(child => child.type === 'image' ? '' : child.content).join('').trim();
    }

    // Returns the address of a link in the manual; null if the target is not part of the manual.
    target(href, env) {
        if (/^[a-z]+:/.test(href))
            return href;
        const [path, id = ''] = href.split('#');
        const file = path ? normalize(join(dirname(env.file), path)) : env.file;
        const place = this.site.places.get(`${file}#${id}`) ?? this.site.places.get(`${file}#`);
        if (place)
            return place;
        if (/^samples\/[^/]+\.fl$/.test(file))
            return `gallery.html#${file.slice(8, -3)}`;
        if (/^lib\/include\/petri(-draw)?\.h$/.test(file))
            return `c.html#${slug(file.slice(12))}`;
        return null;
    }

    image(src, alt, env) {
        const file = normalize(join(dirname(env.file), src)), name = file.replaceAll('/', '-');
        if (!existsSync(join(this.site.root, file)))
            throw new Error(`${env.file}: the picture ${src} does not exist`);
        mkdirSync(join(this.site.output, 'pictures'), { recursive: true });
        copyFileSync(join(this.site.root, file), join(this.site.output, 'pictures', name));
        const [width, height] = sizeOf(readFileSync(join(this.site.root, file)));
        return `<img src="pictures/${name}" alt="${escape(alt)}" width="${width}" height="${height}" loading="lazy">`;
    }

    // Converts a part to HTML. `env` collects sections for the search.
    render(markdown, env) {
        Object.assign(env, { open: [], behind: [] });
        return this.md.render(markdown, env);
    }

    // Returns the HTML of a `<petri-dish>` for each picture in this paragraph or table, and empties their list.
    behind(env) {
        return env.behind.splice(0).map(script => this.site.examples.behind(script, env)).join('');
    }
}

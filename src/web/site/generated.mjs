// generated.mjs: generates pages from petri's tables (petri-manual tables.json), its headers and the samples.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { slug } from './pages.mjs';
import { escape, freeName, inlineCode } from './text.mjs';

const section = (env, level, wanted, title, text = '') => {
    const id = freeName(wanted, env);
    env.sections.push({ level, title, id, text });
    return `<h${level} id="${id}">${escape(title)} <a class="here" href="#${id}" aria-label="Link to ${escape(title)}">#</a></h${level}>\n`;
};
const cells = (kind, row) => `<tr>${row.map(cell => `<${kind}>${cell}</${kind}>`).join('')}</tr>\n`;
const table = (heads, rows) => `<div class="table" tabindex="0" role="group" aria-label="Table"><table>\n${
    cells('th', heads)}${rows.map(row => cells('td', row)).join('')}</table></div>\n`;
const code = text => text ? inlineCode(text) : '';

// Converts paragraphs in the format of `petri help` to HTML. Words in quotes become code.
const paragraphs = text => text.trim().split('\n\n').map(part =>
    `<p>${escape(part.replaceAll('\n', ' ')).replace(/(?<![\w])'([^']+)'/g, '<code>$1</code>')}</p>\n`).join('');

// Returns an option as users type it.
const written = ({ letter, name, value }) => `${letter ? `-${letter}, ` : ''}--${name}${value ? ` ${value}` : ''}`;

export const GENERATED = {
    functions({ tables: { functions, words } }, env) {
        const rows = functions.map(({ name, parameters, help }) => {
            env.names.add(name);
            env.sections.push({ level: 3, title: `${name}(${parameters})`, id: name, text: help });
            return [`<code id="${name}">${escape(`${name}(${parameters})`)}</code>`, escape(help)];
        });
        const unique = words.filter(({ form }, i) => i === 0 || form !== words[i - 1].form);
        return `${section(env, 2, 'all-functions', 'Functions')}${table(['function', ''], rows)}`
            + section(env, 2, 'all-words', 'Values, keywords and operators', unique.map(({ form, help }) => `${form} ${help}`).join(' '))
            + table(['form', ''], unique.map(({ form, help }) => [code(form), escape(help)]));
    },

    nodes({ tables: { nodes, letters } }, env) {
        let area = '';
        return nodes.map(({ name, area: its, help, formula, attributes }) => {
            const begin = its === area ? ''
                : section(env, 2, `area-${its}`, its) + (its === 'physics' ? `<p>${escape(letters)}</p>\n` : '');
            const about = `${help} ${attributes.map(one => `${one.name} ${one.help}`).join(' ')}`;
            area = its;
            return begin + section(env, 3, `${its}-${name}`, `!${name}`, about)
                + `<p>${escape(help)}</p>\n` + (formula ? `<pre tabindex="0" class="formula"><code>${escape(formula)}</code></pre>\n` : '')
                + (attributes.length ? table(['attribute', 'type', 'unit', 'default', ''], attributes.map(one =>
                    [code(one.name), escape(one.type), escape(one.unit), code(one.defaultValue), escape(one.help)])) : '');
        }).join('');
    },

    options({ tables: { commands, statuses, variables, beginning } }, env) {
        return paragraphs(beginning) + commands.map(({ name, operands, summary, details, examples, options }) =>
            section(env, 2, name.toLowerCase().replace(/\W+/g, '-'), `petri ${name}`,
                `${summary} ${details} ${options.map(one => `--${one.name} ${one.help}`).join(' ')}`)
            + `<p>${escape(summary)}: <code>petri ${name}${options.length ? ' [options]' : ''} ${escape(operands)}</code></p>\n`
            + paragraphs(details)
            + (options.length ? table(['option', ''], options.map(one => [code(written(one)), escape(one.help)])) : '')
            + (examples ? `<pre tabindex="0"><code>${escape(examples.replace(/^ {2}/gm, ''))}</code></pre>\n` : '')).join('')
            + section(env, 2, 'exit-status', 'Exit status') + table(['status', ''], statuses.map(row => [code(row.name), escape(row.help)]))
            + section(env, 2, 'environment', 'Environment')
            + table(['variable', ''], variables.map(row => [code(row.name), escape(row.help)]));
    },

    prompt({ tables: { prompt } }, env) {
        const about = prompt.map(({ name, help }) => `${name} ${help}`).join(' ');
        return section(env, 2, 'commands-of-the-prompt', 'Commands of the prompt', about)
            + table(['command', ''], prompt.map(({ name, operands, help }) => [code(`${name} ${operands}`.trim()), escape(help)]));
    },

    // Generates the page of the C headers. Comments at the start of a line become text; declarations between them are shown as code.
    headers({ root, text: { md } }, env) {
        return ['petri.h', 'petri-draw.h', 'petri-edit.h', 'petri-ranks.h'].map(name => {
            const [, ...lines] = readFileSync(join(root, 'lib/include', name), 'utf8').split('\n');
            let html = section(env, 2, slug(name), name), text = [], shown = [];
            const end = () => {
                const found = [...shown.join('\n').matchAll(/\b(petri_\w+)\(|^\} (Petri\w+);/gm)].map(match => match[1] ?? match[2]);
                const names = [...new Set(found)].filter(one => !env.names.has(one));
                const about = text.join(' ');
                html += text.length ? `<p>${md.renderInline(about).replaceAll(/ - (?=[A-Z])/g, '<br>– ')}</p>\n` : '';
                for (const one of names) {
                    env.names.add(one);
                    env.sections.push({ level: 3, title: one, id: one, text: about });
                }
                const anchors = names.map(one => `<a id="${one}"></a>`).join(''), declared = shown.join('\n').trim();
                html += declared ? `${anchors}<pre tabindex="0"><code>${escape(declared)}</code></pre>\n` : '';
                [text, shown] = [[], []];
            };
            for (const line of lines) {
                if (/^#(if|ifdef|ifndef|else|endif|include|define PETRI(_DRAW)?_H)|^extern "C"|^\}$/.test(line))
                    continue;
                if (line.startsWith('//')) {
                    if (shown.join('').trim())
                        end();
                    text.push(line.slice(2).trim());
                } else {
                    shown.push(line);
                }
            }
            end();
            return html;
        }).join('');
    },

    // Generates the scenes of the tests, each with the picture that petri renders.
    scenes({ root, examples, text }, env) {
        const folder = 'tests/pictures/scenes';
        const names = readdirSync(join(root, folder)).filter(name => name.endsWith('.png')).map(name => name.slice(0, -4));
        return section(env, 2, 'scenes-to-run', 'Scenes to run') + names.map(name =>
            `${section(env, 3, `scene-${name}`, name)}<p>${text.image(`${name}.png`, `The scene ${name}`, { file: `${folder}/x` })}</p>\n${
                examples.behind(`${folder}/${name}.fl`, env)}`).join('');
    },

    // Generates the gallery: all samples that draw pictures, and the modules that they read. If a sample cannot run, its picture is shown.
    gallery({ root, output, examples, text }, env) {
        const folder = join(root, 'samples'), names = readdirSync(folder).filter(name => name.endsWith('.fl'));
        const modules = readdirSync(join(folder, 'lib'));
        mkdirSync(join(output, 'lib'), { recursive: true });
        modules.forEach(name => copyFileSync(join(folder, 'lib', name), join(output, 'lib', name)));
        const files = Object.fromEntries(modules.map(name => [`lib/${name}`, readFileSync(join(folder, 'lib', name), 'utf8')]));
        return names.map(name => {
            const script = readFileSync(join(folder, name), 'utf8'), id = name.slice(0, -3);
            copyFileSync(join(folder, name), join(output, name));
            const used = Object.keys(files).filter(file => script.includes(file));
            examples.all.push({ page: env.page, kind: 'dish', text: script, files });
            const picture = [`pictures/${id}.png`, `${id}.png`].find(file => existsSync(join(folder, file)));
            const given = used.length ? ` files="${used.join(' ')}"` : '';
            return section(env, 3, id, name)
                + `<petri-dish src="${name}"${given} controls frame="60" label="The sample ${name}">`
                + `${picture ? text.image(picture, `A frame of ${name}`, { file: 'samples/README.md' }) : ''}</petri-dish>\n`
                + `<details><summary>${name}</summary>\n${examples.code(script)}</details>\n`;
        }).join('');
    },
};

// lessons.mjs: reads the lessons of the tour. A lesson is a Markdown file: front matter, text, and two blocks, `start` and `solution`.
//
// Front matter: title; task; frame, up to which the task runs the script; check, an expression of the language that must be true for the
// state after this frame; tree, a regular expression that its nodes must match; film, the number of frames of the video (only the last
// lesson). A value can be enclosed in single quotes.
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const FOLDER = join(dirname(fileURLToPath(import.meta.url)), 'lessons');

function read(file) {
    const [, front, body] = readFileSync(join(FOLDER, file), 'utf8').match(/^---\n([^]*?)\n---\n([^]*)$/);
    const fields = Object.fromEntries(front.split('\n').map(line => line.match(/^(\w+): (?:'(.*)'|(.*))$/))
        .map(([, key, quoted, plain]) => [key, quoted ?? plain]));
    const block = name => body.match(new RegExp(`^\`\`\`${name}\n([^]*?)^\`\`\``, 'm'))[1];
    return {
        ...fields, name: file.replace(/^\d+-|\.md$/g, ''), frame: Number(fields.frame), film: Number(fields.film ?? 0),
        start: block('start'), solution: block('solution'), prose: body.replaceAll(/^```[^]*?^```\n/gm, ''),
    };
}

export const LESSONS = readdirSync(FOLDER).filter(name => name.endsWith('.md')).sort().map(read);

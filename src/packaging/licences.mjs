// licences.mjs: writes the licence texts of the packages that a bundle contains.
//
// usage: node licences.mjs OUTPUT [--bundle METAFILE] [NAME=FILE...]. METAFILE is esbuild's; the paths in it are relative
// to the current folder. FILE contains the licence of NAME; of a C header, only the first comment is taken.
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const RULER = '-'.repeat(80);

// Returns names and licences of all packages in an esbuild metafile, sorted by name. Throws if a package has no licence file.
export function packagesOf(metafile) {
    const folders = Object.keys(metafile.inputs).map(path => /^(?:\(disabled\):)?(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]);
    return [...new Set(folders)].filter(Boolean).map(folder => {
        const { name, version } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
        const file = readdirSync(folder).find(entry => /^(licen[sc]e|copying)/i.test(entry));
        if (!file)
            throw new Error(`${name} has no licence file`);
        return { name: `${name} ${version}`, text: readFileSync(join(folder, file), 'utf8') };
    }).sort((a, b) => (a.name < b.name ? -1 : 1));
}

export function licenceOfFile(name, path) {
    const text = readFileSync(path, 'utf8');
    return { name, text: path.endsWith('.h') ? /\/\*([^]*?)\*\//.exec(text)[1].replace(/^ \* ?/gm, '') : text };
}

export function writeLicences(path, packages) {
    const sections = packages.map(({ name, text }) => `${RULER}\n${name}\n${RULER}\n\n${text.trim()}\n`);
    writeFileSync(path, `petri contains the following packages. These are their licences.\n\n${sections.join('\n')}`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [, , output, ...rest] = process.argv, packages = [];
    if (rest[0] === '--bundle')
        packages.push(...packagesOf(JSON.parse(readFileSync(rest.splice(0, 2)[1], 'utf8'))));
    for (const argument of rest) {
        const [name, path] = argument.split('=');
        if (!existsSync(path))
            throw new Error(`no such file: ${path}`);
        packages.push(licenceOfFile(name, path));
    }
    writeLicences(output, packages);
}

// licences.test.mjs: the outputs of `./dev web` contain the licences of the packages in them. Needs no browser.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const web = process.env.PETRI_WEB, source = join(dirname(fileURLToPath(import.meta.url)), '../../src/web');
const options = { skip: web && existsSync(join(web, 'page.js')) ? false : 'nothing there: ./dev web makes it' };

// Returns the names of the packages that the modules of a folder import.
function imported(folder, modules) {
    const names = modules.flatMap(module => [...readFileSync(join(source, folder, module), 'utf8')
        .matchAll(/(?:from|import\()\s*'((?:@[\w-]+\/)?[\w][\w.-]*)/g)].map(found => found[1]));
    return [...new Set(names)].filter(name => existsSync(join(source, folder, 'node_modules', name)));
}

function containsLicences(path, folder, names) {
    const text = readFileSync(join(web, path), 'utf8');
    for (const name of names) {
        const home = join(source, folder, 'node_modules', name);
        const file = readdirSync(home).find(entry => /^licen[sc]e/i.test(entry));
        assert(text.includes(readFileSync(join(home, file), 'utf8').trim()), `${path} has the licence of ${name}`);
        assert.match(text, new RegExp(`^${name} \\d`, 'm'));
    }
}

test('the page contains the licences of its packages', options, () => {
    const onlyTools = ['build.mjs', 'serve.mjs'];
    const names = imported('page', readdirSync(join(source, 'page')).filter(name => name.endsWith('.mjs') && !onlyTools.includes(name)));
    assert(names.includes('@codemirror/view'), names.join(' '));
    containsLicences('third-party-licences.txt', 'page', [...names, '@lezer/common', 'style-mod', 'w3c-keyname']);
    assert.equal(readFileSync(join(web, 'petri/page/third-party-licences.txt'), 'utf8'),
        readFileSync(join(web, 'third-party-licences.txt'), 'utf8'));
});

test('the manual contains the licences of its packages', options, () =>
    containsLicences('manual/third-party-licences.txt', 'site', imported('site', ['search.mjs', 'try.mjs'])));

test('the npm package contains the licences of the C code in the engine', options, () => {
    const text = readFileSync(join(web, 'petri/third-party-licences.txt'), 'utf8');
    assert.match(text, /xxHash[^]*Yann Collet[^]*Redistributions in binary form must reproduce/);
    assert.match(text, /musl as a whole is licensed under[^]*MIT license/);
    assert(JSON.parse(readFileSync(join(web, 'petri/package.json'), 'utf8')).files.includes('third-party-licences.txt'));
});

// search.test.mjs: tests that the search of the manual finds the expected page for each query of queries.json, which people typed.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { runInThisContext } from 'node:vm';
import { folder, root } from './browser.mjs';

const index = join(folder, 'manual/index.js'), missing = existsSync(index) ? false : 'missing: the manual';
const FIRST = 3; // the page must be among the first results
const queries = JSON.parse(readFileSync(join(root, 'tests/web/queries.json'), 'utf8'));

// Returns a function that returns the addresses of the results.
function searched() {
    for (const file of ['index.js', 'search.js'])
        runInThisContext(readFileSync(join(folder, 'manual', file), 'utf8'));
    const { pages } = globalThis.PETRI_INDEX, search = globalThis.PETRI_SEARCH(globalThis.PETRI_INDEX);
    return text => search(text).map(({ section: [page, , id] }) => `${pages[page][0]}#${id}`);
}

test('the search finds the expected page for 50 queries, with typing errors and synonyms', { skip: missing }, () => {
    const search = searched();
    assert.equal(queries.length, 50);
    const failed = queries.map(([query, page]) => [query, page, search(query).slice(0, FIRST)])
        .filter(([, page, found]) => !found.some(address => address.startsWith(page)));
    assert.deepEqual(failed, []);
});

test('one mistyped word is found beside others, but two are not guessed', { skip: missing }, () => {
    const search = searched();
    assert.ok(search('gravty strength').some(address => address.startsWith('physics.html#gravity')));
    assert.ok(search('strength gravty').some(address => address.startsWith('physics.html#gravity')));
    assert.deepEqual(search('gravty strenght'), []);
});

test('an everyday word finds what the words of its row find', { skip: missing }, () => {
    const search = searched(), { synonyms } = globalThis.PETRI_INDEX;
    const words = Object.keys(synonyms);
    assert.ok(words.length > 150);
    assert.deepEqual(words.filter(word => synonyms[word].length && !search(word).length), []);
});

test('the search finds nothing for a word that no page has', { skip: missing }, () => {
    const search = searched();
    const unknown = ['xyzzyx', 'kubernetes', 'zebra', 'umbrella', 'how to bake bread', 'constructor', '__proto__', 'hasownproperty'];
    assert.deepEqual(unknown.filter(word => search(word).length), []);
    assert.deepEqual(search('  '), []);
    assert.ok(search('the').length > 0);
});

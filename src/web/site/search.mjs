// search.mjs: the search of the manual with MiniSearch: prefixes, typing errors and synonyms. Bundled as a classic script, which sets
// `PETRI_SEARCH`, because pages opened from a file cannot load modules.
import MiniSearch from 'minisearch';

const IGNORED = new Set(['a', 'an', 'and', 'are', 'at', 'can', 'do', 'does', 'how', 'i', 'in', 'is', 'it', 'make', 'my', 'of', 'on', 'the',
    'to', 'use', 'what', 'with']);
const MAX_RESULTS = 15;
const SYNONYM = 0.7, PREFIX = 0.4, FUZZY = 0.3; // worth of these matches compared with the word
const editsOf = word => word.length < 5 ? 0 : word.length < 7 ? 1 : 2; // in a word with typing errors

const wordsOf = text => text.toLowerCase().match(/[\p{L}\p{N}_]+/gu) ?? [];

// Removes endings, so that `colours` finds `colour`, and `saving` finds `save`.
const stem = word => word.length < 4 ? word
    : word.replace(/ies$/, 'y').replace(/(?<=[^s])s$/, '').replace(/(?<=...)(ing|ed)$/, '').replace(/(?<=...)e$/, '');

// Returns a function that returns the best sections for a text, as rows of the index. `synonyms` maps words to words of the manual.
export function makeSearch({ pages, sections, synonyms }) {
    const synonymsOf = word => Object.hasOwn(synonyms, word) ? synonyms[word] : [];
    const search = new MiniSearch({ fields: ['title', 'page', 'text'], tokenize: wordsOf, processTerm: stem });
    search.addAll(sections.map(([page, title, , text], id) => ({ id, title, page: pages[page][1], text })));
    const query = (word, boost, { prefix, fuzzy }) => ({
        queries: [word], boost: { title: 6 * boost, page: 2 * boost, text: boost },
        prefix: prefix && word.length > 1, fuzzy: fuzzy && editsOf(word), weights: { prefix: PREFIX, fuzzy: FUZZY },
    });
    const alternatives = (word, fuzzy) => ({
        combineWith: 'OR', queries: [query(word, 1, { prefix: true, fuzzy }), ...synonymsOf(word).map(other => query(other, SYNONYM, {}))],
    });
    const titles = sections.map(([, title]) => wordsOf(title.replace(/\(.*/, '')).map(stem).join(' '));
    return text => {
        const asked = wordsOf(text), some = asked.filter(word => !IGNORED.has(word)), words = some.length ? some : asked;
        if (!words.length)
            return [];
        // Sections whose title is the text or a synonym come first.
        const title = asked.map(stem).join(' '), others = words.length === 1 ? synonymsOf(words[0]).map(stem) : [];
        const boostDocument = id => titles[id] === title ? 4 : others.includes(titles[id]) ? 3 : 1;
        const find = (options, mistyped) => search.search(
            { queries: words.map((word, i) => alternatives(word, i === mistyped)), ...options }, { boostDocument });
        const has = (terms, word) => [word, ...synonymsOf(word)].some(one => terms.includes(stem(one)));
        const half = ({ queryTerms }) => words.filter(word => has(queryTerms, word)).length * 2 >= words.length;
        // If no section has all words, one of them may be mistyped. If this finds nothing either, half of the words suffice.
        const ways = [() => find({ combineWith: 'AND' }), ...words.map((_, i) => () => find({ combineWith: 'AND' }, i)),
            () => find({ combineWith: 'OR', filter: half })];
        const found = ways.reduce((list, next) => list.length ? list : next(), []);
        return found.slice(0, MAX_RESULTS).map(({ id, terms }) => ({ section: sections[id], terms }));
    };
}

globalThis.PETRI_SEARCH = makeSearch;

// matches.mjs: shows how many matches the search of the editor has.
import { getSearchQuery, searchPanelOpen } from '@codemirror/search';
import { EditorView } from '@codemirror/view';

const MAX = 1000; // matches that are counted

function describe(state) {
    const query = getSearchQuery(state);
    if (!query.search)
        return '';
    if (!query.valid)
        return 'not a regular expression';
    const cursor = query.getCursor(state);
    let count = 0;
    while (count < MAX && !cursor.next().done)
        count++;
    return count === 0 ? 'no matches' : count === 1 ? '1 match' : `${count}${count === MAX ? ' or more' : ''} matches`;
}

export const showMatches = EditorView.updateListener.of(({ view, state }) => {
    const panel = searchPanelOpen(state) && view.dom.querySelector('.cm-search');
    if (!panel)
        return;
    const line = panel.querySelector('output') ?? panel.appendChild(document.createElement('output')), text = describe(state);
    if (line.textContent !== text)
        line.textContent = text;
});

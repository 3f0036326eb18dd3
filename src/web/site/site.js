// site.js: search, theme and offline use. This is not a module, because modules do not work on pages opened from a file.
'use strict';
{
    const $ = id => document.getElementById(id), find = $('find'), found = $('found');
    const THEME = 'petri.theme';
    let asked = null;

    // The index and the search are loaded at the first search. They are scripts, because pages opened from a file cannot use fetch.
    const load = src => new Promise((resolve, reject) => document.head.append(
        Object.assign(document.createElement('script'), { src, onload: resolve, onerror: reject })));
    const searcher = () => (asked ??= Promise.all([load('index.js'), load('search.js')])
        .then(() => globalThis.PETRI_SEARCH(globalThis.PETRI_INDEX)));

    // Returns an excerpt of the text around the first match.
    function around(text, words) {
        const places = words.map(word => text.toLowerCase().indexOf(word)).filter(place => place >= 0);
        const at = Math.max(0, Math.min(...places, text.length) - 60);
        const start = at && text.indexOf(' ', at) + 1;
        const end = text.length > start + 180 ? text.lastIndexOf(' ', start + 180) : text.length;
        return `${start ? '… ' : ''}${text.slice(start, end)}${end < text.length ? ' …' : ''}`;
    }

    async function search() {
        found.hidden = !find.value.trim();
        if (found.hidden)
            return;
        const search = await searcher(), { pages } = globalThis.PETRI_INDEX, best = search(find.value);
        const list = document.createElement('ul');
        list.append(...best.map(({ section: [page, title, id, text], terms }) => {
            const item = document.createElement('li'), link = document.createElement('a'), small = document.createElement('small');
            link.href = `${pages[page][0]}#${id}`;
            link.textContent = title === pages[page][1] ? title : `${pages[page][1]}: ${title}`;
            link.onclick = () => (found.hidden = true);
            small.textContent = around(text, terms);
            item.append(link, small);
            return item;
        }));
        found.replaceChildren(best.length ? list : 'No results.');
    }

    find.oninput = () => search().catch(() => found.replaceChildren('Cannot load the search index.'));
    find.form.onsubmit = event => {
        event.preventDefault();
        found.querySelector('a')?.click();
    };
    addEventListener('keydown', event => {
        const links = [...found.querySelectorAll('a')], at = links.indexOf(document.activeElement);
        if (event.key === '/' && !/^(INPUT|TEXTAREA|PETRI-DISH)$/.test(document.activeElement.tagName)) {
            event.preventDefault();
            find.focus();
        } else if (event.key === 'Escape' && !found.hidden) {
            found.hidden = true;
            find.focus();
        } else if (!found.hidden && (at >= 0 || document.activeElement === find) && /^Arrow(Up|Down)$/.test(event.key)) {
            event.preventDefault();
            ([find, ...links][at + 1 + (event.key === 'ArrowDown' ? 1 : -1)] ?? find).focus();
        }
    });

    const kept = () => {
        try {
            return localStorage.getItem(THEME);
        } catch {
            return null;
        }
    };
    document.documentElement.dataset.theme = kept() ?? '';
    $('theme').onclick = () => {
        const { theme } = document.documentElement.dataset;
        const dark = theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
        document.documentElement.dataset.theme = dark ? 'light' : 'dark';
        try {
            localStorage.setItem(THEME, dark ? 'light' : 'dark');
        } catch {
            // without storage, the theme is not remembered
        }
    };

    if (innerWidth <= 760)
        document.querySelector('nav details').open = false;
    $('served').hidden = location.protocol !== 'file:';
    if (location.protocol !== 'file:' && 'serviceWorker' in navigator)
        navigator.serviceWorker.register('../offline.js').then(() => navigator.serviceWorker.ready)
            .then(({ active }) => active.postMessage('manual/')).catch(() => {});
}

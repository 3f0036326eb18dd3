// theme.mjs: the setting for dark or light, which the page shares with the manual (site.js).

const PLACE = 'petri.theme';

function stored() {
    try {
        return localStorage.getItem(PLACE) ?? '';
    } catch {
        return ''; // the browser blocks its storage
    }
}

export function applyTheme() {
    document.documentElement.dataset.theme = stored();
}

// Makes a button that switches between dark and light, here and in other tabs.
export function listenForTheme(button) {
    button.onclick = () => {
        const { theme } = document.documentElement.dataset;
        const next = (theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches) ? 'light' : 'dark';
        document.documentElement.dataset.theme = next;
        try {
            localStorage.setItem(PLACE, next);
        } catch {
            // without storage, the theme is not remembered
        }
    };
    addEventListener('storage', ({ key }) => key === PLACE && applyTheme());
}

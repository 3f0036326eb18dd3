// theme.mjs: the setting for dark or light, which the page shares with the manual (site.js).
import { readSetting, storeSetting } from './settings.mjs';

const PLACE = 'petri.theme';

export function applyTheme() {
    document.documentElement.dataset.theme = readSetting(PLACE) ?? '';
}

// Makes a button that switches between dark and light, here and in other tabs.
export function listenForTheme(button) {
    button.onclick = () => {
        const { theme } = document.documentElement.dataset;
        const next = (theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches) ? 'light' : 'dark';
        document.documentElement.dataset.theme = next;
        storeSetting(PLACE, next);
    };
    addEventListener('storage', ({ key }) => key === PLACE && applyTheme());
}

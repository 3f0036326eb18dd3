// saved_scripts.mjs: stores the last few edited scripts in the browser.

const PLACE = 'petri.scripts';
const MAX_SCRIPTS = 12;

// Returns the scripts, newest first: { name, text, when }.
export function savedScripts() {
    try {
        return JSON.parse(localStorage.getItem(PLACE)) ?? [];
    } catch {
        return [];
    }
}

export class ScriptSaver {
    // Starts a new entry: the next text does not replace the current entry.
    begin() {
        this.when = null;
    }

    keep(name, text) {
        const others = savedScripts().filter(({ when, text: same }) => when !== this.when && same !== text);
        this.when ??= Date.now();
        const scripts = [{ name, text, when: this.when }, ...others];
        // The browser limits storage to a few million characters, so older scripts are dropped. Private windows may store nothing.
        for (let count = Math.min(MAX_SCRIPTS, scripts.length); count > 0; count--)
            try {
                localStorage.setItem(PLACE, JSON.stringify(scripts.slice(0, count)));
                return;
            } catch {
                // retry with one script fewer
            }
    }
}

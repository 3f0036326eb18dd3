// saved_scripts.mjs: what was written here, in the browser's storage: the last few scripts, each as it was left.

const PLACE = 'petri.scripts';
const MAX_SCRIPTS = 12;

// The newest first: { name, text, when }.
export function savedScripts() {
    try {
        return JSON.parse(localStorage.getItem(PLACE)) ?? [];
    } catch {
        return [];
    }
}

export class ScriptSaver {
    // What is written from here on is another script.
    begin() {
        this.when = null;
    }

    keep(name, text) {
        const others = savedScripts().filter(({ when, text: same }) => when !== this.when && same !== text);
        this.when ??= Date.now();
        const scripts = [{ name, text, when: this.when }, ...others];
        // Browsers have room for some millions of letters: older scripts make way. Private windows keep nothing.
        for (let count = Math.min(MAX_SCRIPTS, scripts.length); count > 0; count--)
            try {
                localStorage.setItem(PLACE, JSON.stringify(scripts.slice(0, count)));
                return;
            } catch {
                // with one less, then
            }
    }
}

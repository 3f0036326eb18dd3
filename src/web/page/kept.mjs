// kept.mjs: what was written here, in the browser's storage: the last few scripts, each as it was left.

const PLACE = 'petri.scripts';
const MOST = 12;

// The newest first: { name, text, when }.
export function keptScripts() {
    try {
        return JSON.parse(localStorage.getItem(PLACE)) ?? [];
    } catch {
        return [];
    }
}

export class Keeper {
    // What is written from here on is another script.
    begin() {
        this.when = null;
    }

    keep(name, text) {
        const others = keptScripts().filter(({ when, text: same }) => when !== this.when && same !== text);
        this.when ??= Date.now();
        try {
            localStorage.setItem(PLACE, JSON.stringify([{ name, text, when: this.when }, ...others].slice(0, MOST)));
        } catch {
            // Private windows keep nothing.
        }
    }
}

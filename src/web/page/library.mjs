// library.mjs: the user's scripts in the browser's storage, one item for each.

const PREFIX = 'petri.script.';
const OLD = 'petri.scripts'; // the list in which petri 0.2 stored scripts

const newId = () => Date.now().toString(36) + Math.random().toString(36).slice(2, 6);

export class Library {
    // report: receives the reason why a script cannot be stored, or '' if it was stored.
    constructor(report) {
        this.report = report;
        this.convert();
    }

    // Returns the scripts, last edited first: { id, name, text, when }.
    list() {
        try {
            const ids = Object.keys(localStorage).filter(key => key.startsWith(PREFIX)).map(key => key.slice(PREFIX.length));
            return ids.map(id => this.get(id)).filter(Boolean).sort((a, b) => b.when - a.when);
        } catch {
            return []; // the browser blocks its storage
        }
    }

    get(id) {
        try {
            const { name, text, when } = JSON.parse(localStorage.getItem(PREFIX + id));
            return typeof name === 'string' && typeof text === 'string' ? { id, name, text, when: Number(when) || 0 } : null;
        } catch {
            return null;
        }
    }

    // Stores a script, as a new one if `id` is null. Returns its id.
    keep(id, name, text, when = Date.now()) {
        const key = id ?? newId();
        try {
            localStorage.setItem(PREFIX + key, JSON.stringify({ name, text, when }));
            this.report('');
        } catch (error) {
            this.report(`${name} is not stored: ${error.name === 'QuotaExceededError'
                ? 'the browser\'s storage is full; delete scripts, or save this one as a file.'
                : 'the browser blocks its storage; save the script as a file.'}`);
        }
        return key;
    }

    remove(id) {
        try {
            localStorage.removeItem(PREFIX + id);
        } catch {
            // nothing is stored
        }
    }

    // Returns a name that no stored script has, such as dish-2.fl.
    freeName(name) {
        const used = new Set(this.list().map(script => script.name)), stem = name.replace(/(-\d+)?\.fl$/, '');
        let free = name;
        for (let i = 2; used.has(free); i++)
            free = `${stem}-${i}.fl`;
        return free;
    }

    convert() {
        try {
            for (const { name, text, when } of JSON.parse(localStorage.getItem(OLD)) ?? [])
                localStorage.setItem(PREFIX + when, JSON.stringify({ name, text, when }));
            localStorage.removeItem(OLD);
        } catch {
            // the list stays
        }
    }
}

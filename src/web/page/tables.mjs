// tables.mjs: the state, and watched expressions, as the worker has them for the page.

const COMPONENTS = 4; // of a vector that is watched
const REFILL = 1000; // ms that frames before are made once more for, when something new is watched

// The state as rows, sorted and filtered here: the page gets those that it shows.
export class StateTable {
    constructor() {
        this.made = null;
    }

    rows(player, { filter, by, down, from, count }) {
        const { session, frame } = player;
        if (this.made?.session !== session || this.made.frame !== frame)
            this.made = { session, frame, all: Array.from(session.state), sorted: null };
        const signature = JSON.stringify([filter, by, down]);
        if (this.made.signature !== signature)
            Object.assign(this.made, { signature, sorted: this.sort(filter, by, down) });
        const { sorted, all } = this.made;
        return { total: all.length, matching: sorted.length, rows: sorted.slice(from, from + count) };
    }

    sort(filter, by, down) {
        const wanted = filter.toLowerCase(), { all } = this.made;
        const found = wanted ? all.filter(([key]) => key.toLowerCase().includes(wanted)) : [...all];
        const first = ([, value]) => Array.isArray(value) ? value[0] ?? NaN : NaN;
        if (by === 'value')
            found.sort((a, b) => first(a) - first(b) || 0);
        else if (by === 'key')
            found.sort(([a], [b]) => order.compare(a, b));
        return down ? found.reverse() : found;
    }
}

const order = new Intl.Collator('en', { numeric: true });

// Expressions whose values are kept for each frame.
export class Watches {
    constructor(told) {
        this.told = told;
        this.all = [];
    }

    set(texts) {
        this.all = texts.map(text => this.all.find(watch => watch.text === text) ?? { text, values: [], error: null });
    }

    forget(frame) {
        this.all.forEach(watch => watch.values.splice(frame + 1));
    }

    // The values in the frame that there is.
    see({ session, frame }) {
        for (const watch of this.all) {
            const before = this.told.length;
            try {
                const { text, number } = session.evaluate(watch.text);
                watch.values[frame] = Number.isNaN(number) ? text.split(';').slice(0, COMPONENTS).map(Number) : [number];
                watch.error = watch.values[frame].some(Number.isNaN) && text !== 'null' ? `${watch.text} is no number: ${text}` : null;
            } catch (error) {
                watch.error = error.message.split('\n')[0];
            }
            this.told.length = before;
        }
    }

    // Makes the frames before once more, as far as that goes fast.
    refill(player, shouldInterrupt) {
        const at = player.frame, end = performance.now() + REFILL;
        for (let frame = 0; frame <= player.lastFrame && performance.now() < end && !shouldInterrupt(); frame++)
            player.seek(frame);
        player.seek(at);
    }

    // For each component of each expression as many numbers as there are frames; NaN where it is not known.
    series(most) {
        return this.all.map(({ text, values, error }) => {
            const width = values.reduce((widest, value) => Math.max(widest, value?.length ?? 0), 1);
            const lines = Array.from({ length: width }, (_, k) => Float64Array.from({ length: most + 1 }, (_, i) => values[i]?.[k] ?? NaN));
            return { text, error, lines };
        });
    }
}

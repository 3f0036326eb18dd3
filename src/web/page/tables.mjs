// tables.mjs: the state and watched expressions, in the worker.

const COMPONENTS = 4; // maximum number of components of a watched vector
const REFILL = 1000; // maximum time in ms for recomputing earlier frames when an expression is added

// The state as rows. Rows are sorted and filtered here; the page receives only the visible rows.
export class StateTable {
    constructor() {
        this.made = null;
    }

    rows(player, { filter, by, down, from, count }) {
        const { session, frame } = player;
        if (this.made?.session !== session || this.made.frame !== frame)
            this.made = { session, frame, all: Array.from(session.state), digest: frame < 0 ? null : session.digest(), sorted: null };
        const signature = JSON.stringify([filter, by, down]);
        if (this.made.signature !== signature)
            Object.assign(this.made, { signature, sorted: this.sort(filter, by, down) });
        const { sorted, all, digest } = this.made;
        return { digest, total: all.length, matching: sorted.length, rows: sorted.slice(from, from + count) };
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

// Expressions whose values are recorded in each frame.
export class Watches {
    constructor(reported) {
        this.reported = reported;
        this.all = [];
    }

    set(texts) {
        this.all = texts.map(text => this.all.find(watch => watch.text === text) ?? { text, values: [], error: null });
    }

    forget(frame) {
        this.all.forEach(watch => watch.values.splice(frame + 1));
    }

    // Records the values in the current frame.
    see({ session, frame }) {
        for (const watch of this.all) {
            const before = this.reported.length;
            try {
                const { text, number } = session.evaluate(watch.text);
                watch.values[frame] = Number.isNaN(number) ? text.split(';').slice(0, COMPONENTS).map(Number) : [number];
                watch.error = watch.values[frame].some(Number.isNaN) && text !== 'null' ? `${watch.text} is not a number: ${text}` : null;
            } catch (error) {
                watch.error = error.message.split('\n')[0];
            }
            this.reported.length = before;
        }
    }

    // Recomputes the frames from 0 on to record the values of all expressions in them. Stops after REFILL ms.
    refill(player, shouldInterrupt) {
        const at = player.frame, end = performance.now() + REFILL;
        for (let frame = 0; frame <= player.lastFrame && performance.now() < end && !shouldInterrupt(); frame++)
            player.seek(frame);
        player.seek(at);
    }

    // Returns the values of each expression: for each component, an array with one number per frame, NaN if the value is unknown.
    series(max) {
        return this.all.map(({ text, values, error }) => {
            const width = values.reduce((widest, value) => Math.max(widest, value?.length ?? 0), 1);
            const lines = Array.from({ length: width }, (_, k) => Float64Array.from({ length: max + 1 }, (_, i) => values[i]?.[k] ?? NaN));
            return { text, error, lines };
        });
    }
}

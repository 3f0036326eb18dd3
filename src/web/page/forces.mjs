// forces.mjs: the chosen particle and the forces on it, in the worker.
import { pictureSize } from '../engine/drawing.mjs';
import { originsOf } from './origin.mjs';
import { pick } from './pick.mjs';

// Returns true if two display lists are equal. If the list of the script equals the automatic one, the script draws nothing.
const sameNumbers = (a, b) => a.length === b.length && a.every((number, i) => Object.is(number, b[i]));

export class Forces {
    constructor() {
        this.chosen = null; // { name, id, system, particle }: name of the system, id as text, last known numbers
    }

    // Chooses the particle at a point of the picture; x and y are 0 at the top left and 1 at the bottom right. Returns false, and keeps the
    // chosen particle, if there is none.
    choose({ session, automatic }, x, y) {
        const list = session.displayList({ automatic }), made = session.displayList({ automatic: true });
        if (!list || !made)
            return false;
        const { width, height } = pictureSize(list.numbers), { systems } = session;
        const found = pick(list.numbers, systems, sameNumbers(list.numbers, made.numbers), x * width, y * height);
        if (found)
            this.chosen = { ...found, name: systems[found.system].name, id: session.particleId(found.system, found.particle) };
        return found !== null;
    }

    // Finds the chosen particle in the last frame. Returns its system, or null if there is no such particle.
    find(session) {
        const { chosen } = this, systems = chosen ? session.systems : [];
        const number = systems.findIndex(({ name }) => name === chosen.name), count = systems[number]?.count ?? 0;
        const has = particle => particle < count && session.particleId(number, particle) === chosen.id;
        for (let i = -1; i < count; i++) { // the number of a particle rarely changes
            const particle = i < 0 ? chosen.particle : i;
            if (has(particle)) {
                Object.assign(chosen, { system: number, particle });
                return systems[number];
            }
        }
        return null;
    }

    // Returns what the page shows of the chosen particle: its key, entries of the state, contributions and their sum. If there is nothing
    // to show, `note` gives the reason.
    describe({ session, text, name: file }) {
        if (!this.chosen)
            return { key: null };
        const { name, id } = this.chosen, key = `${name};${id}`, system = this.find(session);
        const origin = { file, origins: originsOf(text, name, id) };
        if (!system)
            return { key, ...origin, note: 'is not in this frame' };
        const state = [`$(${key})`, `$(${key};:velocity)`].map(entry => [entry, session.evaluate(entry).text]);
        if (!system.steps)
            return { key, ...origin, state, note: 'took no step in this frame' };
        const { contributions, sum } = session.explain(this.chosen.system, this.chosen.particle);
        return { key, ...origin, state, contributions, sum, note: contributions.length ? '' : 'no force acts on it' };
    }
}

// pick.mjs: finds the particle at a point of a picture, in the worker.
import { COMMANDS, PATH_ELEMENTS } from '../engine/constants.mjs';
import { Reader } from '../engine/drawing.mjs';

const UNSUPPORTED = COMMANDS.findIndex(([name]) => name === 'unsupported');
const MIN_RADIUS = 6; // in the picture's units: how close to the centre of a small circle a click must be

const IDENTITY = [1, 0, 0, 1, 0, 0];
const MAX_FRAMES = 32, MAX_CIRCLES = 4, MAX_SAMPLES = 20; // bounds of the search for the coordinate system of the particles

// Executes the commands of a display list that determine where circles are. All other commands do nothing.
class CircleReader {
    constructor(numbers) {
        Object.assign(this, { circles: [], frames: [IDENTITY], panel: -1, transform: IDENTITY });
        this.painter = new Proxy(this, { get: (target, name) => target[name]?.bind?.(target) ?? (() => {}) });
        this.reader = new Reader(this.painter, numbers, 3);
        while (this.reader.at < numbers.length)
            this.command();
    }

    command() {
        COMMANDS[this.reader.number()][1](this.reader, this.painter);
    }

    readPaint() {
        this.command();
        while (this.reader.n[this.reader.at] === UNSUPPORTED)
            this.command();
    }

    matrix(matrix) {
        this.transform = matrix;
        if (this.frames.length < MAX_FRAMES && !this.frames.some(other => other.every((number, i) => number === matrix[i])))
            this.frames.push(matrix);
    }

    // In an automatic picture, each system has a panel, which begins with a clip.
    clip() {
        this.panel++;
    }

    path(fill, stroke, rule, { n, at, end }) {
        while (at < end) {
            const [name, size] = PATH_ELEMENTS[n[at++]];
            if (name === 'arc')
                this.add(n[at], n[at + 1], Math.max(Math.abs(n[at + 2]), Math.abs(n[at + 3])));
            at += size;
        }
    }

    add(x, y, radius) {
        const [xx, yx, xy, yy, x0, y0] = this.transform, scale = scaleOf(this.transform);
        this.circles.push({
            panel: this.panel, linear: this.transform.slice(0, 4), x: xx * x + xy * y + x0, y: yx * x + yy * y + y0, radius: radius * scale,
        });
    }
}

const scaleOf = ([xx, yx, xy, yy]) => Math.sqrt(Math.abs(xx * yy - xy * yx));

const isFinitePosition = ({ position: { data, stride }, dimensions }, i) =>
    data.subarray(i * stride, i * stride + dimensions).every(Number.isFinite);

// In the automatic picture of a system with up to two dimensions, circle k belongs to the k-th particle that has a finite position.
function particleOfPanel(systems, circles, hit) {
    const system = systems[hit.panel];
    if (!system?.position || system.dimensions > 2)
        return null;
    let left = circles.filter(({ panel }) => panel === hit.panel).indexOf(hit);
    for (let particle = 0; particle < system.count; particle++)
        if (isFinitePosition(system, particle) && left-- === 0)
            return { system: hit.panel, particle };
    return null;
}

// Returns the particle whose position, in the coordinates of a frame, is closest to the centre of a circle, if it is inside the circle.
function particleAt(systems, frame, { x, y, radius }) {
    const [xx, yx, xy, yy, x0, y0] = frame, determinant = xx * yy - xy * yx, scale = scaleOf(frame);
    const px = (yy * (x - x0) - xy * (y - y0)) / determinant, py = (xx * (y - y0) - yx * (x - x0)) / determinant;
    let best = null, minDistance = radius / scale;
    systems.forEach(({ position, dimensions, count }, system) => {
        for (let particle = 0; particle < count && position; particle++) {
            const at = particle * position.stride;
            const distance = Math.hypot(position.data[at] - px, (dimensions > 1 ? position.data[at + 1] : 0) - py);
            if (distance < minDistance) {
                best = { system, particle };
                minDistance = distance;
            }
        }
    });
    return best;
}

// Returns transforms for scripts that draw 1 to MAX_CIRCLES circles per particle, in the order of the particles, as the first or the last
// circles, and move them with nested transforms. The outer transform is then not in the display list.
function nestedFrames(systems, circles) {
    return systems.flatMap(({ position, dimensions, count }) => {
        const frames = [];
        for (let each = 1; position && each <= MAX_CIRCLES && each * count <= circles.length; each++) {
            for (const { linear, x, y } of [circles[0], circles[circles.length - each * count]]) {
                const [xx, yx, xy, yy] = linear, px = position.data[0], py = dimensions > 1 ? position.data[1] : 0;
                frames.push([...linear, x - xx * px - xy * py, y - yx * px - yy * py]);
            }
        }
        return frames;
    });
}

// Returns the transform with which the script draws particles: the one for which most circles have a particle inside. Circles can have
// other transforms, because scripts also move a circle to a particle with a transform.
function frameOf(systems, frames, circles) {
    const every = Math.max(Math.floor(circles.length / MAX_SAMPLES), 1), samples = circles.filter((circle, i) => i % every === 0);
    let best = IDENTITY, maxCount = 0;
    for (const frame of [...frames, ...nestedFrames(systems, circles)]) {
        const count = scaleOf(frame) > 0 ? samples.filter(circle => particleAt(systems, frame, circle)).length : 0;
        if (count > maxCount)
            [best, maxCount] = [frame, count];
    }
    return best;
}

// Returns { system, particle }, the numbers of the particle at a point, or null. `numbers` is the display list of the last frame, `systems`
// are its systems, and `automatic` is true if petri made the picture. Finds circles that are drawn at the positions of particles.
export function pick(numbers, systems, automatic, x, y) {
    const { circles, frames } = new CircleReader(numbers);
    const frame = automatic ? null : frameOf(systems, frames, circles);
    const isHit = circle => Math.hypot(circle.x - x, circle.y - y) <= Math.max(circle.radius, MIN_RADIUS);
    for (const hit of circles.filter(isHit).reverse()) { // the last one is in front
        const found = automatic ? particleOfPanel(systems, circles, hit) : particleAt(systems, frame, hit);
        if (found)
            return found;
    }
    return null;
}

// noise.mjs: computes pixels of the noise of SVG's feTurbulence and of Perlin's improved noise (lib/draw/noise.c).

const LATTICE = 256, CHANNELS = 4, FOLDED = 1, IMPROVED = 2;

// Yields the random numbers of SVG's feTurbulence, from 1 to 2³¹ − 2.
function* numbersFrom(seed) {
    const MODULUS = 2147483647, FACTOR = 16807, MAX_VALUE = MODULUS - 1, whole = Math.trunc(seed);
    let number = whole <= 0 ? 1 - whole % MAX_VALUE : Math.min(whole, MAX_VALUE);
    for (;;)
        yield number = FACTOR * number % MODULUS; // exact, because the product is below 2⁵³
}

function makeLattice(seed) {
    const numbers = numbersFrom(seed), next = () => numbers.next().value, slopes = [], order = new Uint8Array(LATTICE);
    for (let i = 0; i < CHANNELS * LATTICE; i++) {
        const slope = [0, 0].map(() => (next() % (2 * LATTICE) - LATTICE) / LATTICE), length = Math.hypot(...slope);
        slopes.push(slope.map(x => (length > 0 ? x / length : 0)));
    }
    order.forEach((_, i) => {
        order[i] = i;
    });
    for (let i = LATTICE - 1; i > 0; i--) {
        const other = next() % LATTICE;
        [order[i], order[other]] = [order[other], order[i]];
    }
    return { slopes, order };
}

// Returns the nearest frequency with a whole number of waves per tile, and the number of waves; 0 waves means no tiles.
function fitTile(given, side, other) {
    const frequency = Math.abs(given);
    if (!(side > 0 && other > 0 && frequency > 0))
        return [frequency, 0];
    const low = Math.floor(side * frequency) / side, high = Math.ceil(side * frequency) / side;
    const fitting = low > 0 && frequency / low < high / frequency ? low : high;
    return [fitting, Math.min(Math.floor(side * fitting + 0.5), 2 ** 30)];
}

const wrapped = (cell, tile) => (tile > 0 ? cell - tile * Math.floor(cell / tile) : cell) & (LATTICE - 1);

function placeOf(x, tile) {
    const cell = Math.floor(x);
    return { cell: wrapped(cell, tile), next: wrapped(cell + 1, tile), part: x - cell };
}

const mix = (share, a, b) => a + share * (b - a);
const ease = t => t * t * (3 - 2 * t);
const easeWell = t => t * t * t * (t * (t * 6 - 15) + 10);

function smooth({ slopes, order }, channel, x, y) {
    const at = (i, j, dx, dy) => {
        const slope = slopes[channel * LATTICE + order[(order[i] + j) & (LATTICE - 1)]];
        return dx * slope[0] + dy * slope[1];
    };
    const across = ease(x.part);
    return mix(ease(y.part), mix(across, at(x.cell, y.cell, x.part, y.part), at(x.next, y.cell, x.part - 1, y.part)),
        mix(across, at(x.cell, y.next, x.part, y.part - 1), at(x.next, y.next, x.part - 1, y.part - 1)));
}

// Perlin's improved noise (2002) in the plane z = channel. The gradients point to the midpoints of the twelve edges of a cube.
function improved({ order }, channel, x, y) {
    const at = (i, j, dx, dy) => {
        const edge = order[(order[(order[i] + j) & (LATTICE - 1)] + channel) & (LATTICE - 1)] & 15;
        const u = edge < 8 ? dx : dy, v = edge < 4 ? dy : edge === 12 || edge === 14 ? dx : 0;
        return (edge & 1 ? -u : u) + (edge & 2 ? -v : v);
    };
    const across = easeWell(x.part);
    return mix(easeWell(y.part), mix(across, at(x.cell, y.cell, x.part, y.part), at(x.next, y.cell, x.part - 1, y.part)),
        mix(across, at(x.cell, y.next, x.part, y.part - 1), at(x.next, y.next, x.part - 1, y.part - 1)));
}

// Computes noise (petri-draw.h, PETRI_DRAW_NOISE) as ImageData; `toUnits` is the DOMMatrix from pixels to units.
export function noisePixels([fx, fy, tileX, tileY, seed, octaves, type, alpha], toUnits, width, height) {
    const lattice = makeLattice(seed), wave = type === IMPROVED ? improved : smooth, image = new ImageData(width, height);
    const [frequencyX, cellsX] = fitTile(fx, tileX, tileY), [frequencyY, cellsY] = fitTile(fy, tileY, tileX);
    const { a, b, c, d, e, f } = toUnits, sums = new Float64Array(CHANNELS);
    for (let at = 0, row = 0; row < height; row++)
        for (let column = 0; column < width; column++, at += 4) {
            const u = column + 0.5, v = row + 0.5, x = (a * u + c * v + e) * frequencyX, y = (b * u + d * v + f) * frequencyY;
            sums.fill(0);
            for (let octave = 0, ratio = 1; octave < octaves && ratio < Infinity; octave++, ratio *= 2) {
                if (!(Math.abs(x * ratio) < 1e15 && Math.abs(y * ratio) < 1e15)) // the coordinates have no fractional part
                    break;
                const placeX = placeOf(x * ratio, cellsX * ratio), placeY = placeOf(y * ratio, cellsY * ratio);
                for (let channel = 0; channel < CHANNELS; channel++) {
                    const one = wave(lattice, channel, placeX, placeY);
                    sums[channel] += (type === FOLDED ? Math.abs(one) : one) / ratio;
                }
            }
            for (let channel = 0; channel < CHANNELS; channel++) {
                const sum = type === FOLDED ? sums[channel] : (sums[channel] + 1) / 2;
                image.data[at + channel] = 255 * Math.min(Math.max(sum, 0), 1) * (channel === 3 ? alpha : 1);
            }
        }
    return image;
}

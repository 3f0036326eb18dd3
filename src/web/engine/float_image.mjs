// float_image.mjs: floating-point images with premultiplied values from 0 to 1, and their filters. A port of lib/draw/float_image.c for
// hosts that have only Canvas 2D.

const MAX_SIGMA = 256, MAX_EXACT_SIGMA = 8; // standard deviations of a blur, in pixels

// Rounds to the nearest integer, ties to even.
const nearest = x => (Math.abs(x % 1) === 0.5 ? 2 * Math.round(x / 2) : Math.round(x));

export class FloatImage {
    constructor(width, height, pixels = new Float32Array(4 * width * height)) {
        Object.assign(this, { width, height, pixels });
    }

    static of(context, x, y, width, height) {
        const { data } = context.getImageData(x, y, width, height), sheet = new FloatImage(width, height);
        for (let i = 0; i < data.length; i += 4) {
            const alpha = data[i + 3] / 255;
            for (let k = 0; k < 3; k++)
                sheet.pixels[i + k] = data[i + k] / 255 * alpha;
            sheet.pixels[i + 3] = alpha;
        }
        return sheet;
    }

    put(context) {
        const image = new ImageData(this.width, this.height), { pixels } = this;
        for (let i = 0; i < pixels.length; i += 4) {
            const alpha = Math.min(Math.max(pixels[i + 3], 0), 1);
            for (let k = 0; k < 3; k++)
                image.data[i + k] = alpha > 0 ? 255 * pixels[i + k] / alpha : 0;
            image.data[i + 3] = 255 * alpha;
        }
        context.putImageData(image, 0, 0);
        return context.canvas;
    }

    copy() {
        return new FloatImage(this.width, this.height, this.pixels.slice());
    }

    // Applies `change` to each row (axis 0) or column (axis 1). `change` gets a line of pixels with four numbers each, and returns the new
    // line.
    lines(axis, change) {
        const { width, height, pixels } = this, count = axis ? height : width, step = axis ? 4 * width : 4;
        const line = new Float32Array(4 * count);
        for (let i = 0; i < (axis ? width : height); i++) {
            const start = axis ? 4 * i : 4 * width * i;
            for (let j = 0; j < count; j++)
                for (let k = 0; k < 4; k++)
                    line[4 * j + k] = pixels[start + j * step + k];
            const made = change(line, count);
            for (let j = 0; j < count; j++)
                for (let k = 0; k < 4; k++)
                    pixels[start + j * step + k] = made[4 * j + k];
        }
    }

    blur(sigmas) {
        sigmas.forEach((sigma, axis) => sigma > 0.05 && this.lines(axis, blurOf(Math.min(sigma, MAX_SIGMA))));
        return this;
    }

    // Dilates shapes, or erodes them if `least` is true.
    spread(radii, least) {
        radii.forEach((radius, axis) => {
            const reach = Math.min(nearest(radius), axis ? this.height : this.width);
            if (reach > 0)
                this.lines(axis, spreadOf(reach, least ? Math.min : Math.max));
        });
        return this;
    }

    move(dx, dy) {
        const { width, height } = this, out = new FloatImage(width, height), x0 = nearest(dx), y0 = nearest(dy);
        const first = Math.max(x0, 0), last = Math.min(width, width + x0);
        for (let y = Math.max(y0, 0); y < Math.min(height, height + y0) && last > first; y++) {
            const from = 4 * ((y - y0) * width + first - x0);
            out.pixels.set(this.pixels.subarray(from, from + 4 * (last - first)), 4 * (y * width + first));
        }
        return out;
    }

    // Sets all pixels to one colour, whose alpha is multiplied by the alpha of each pixel.
    shade([red, green, blue, alpha]) {
        for (let i = 0; i < this.pixels.length; i += 4) {
            const there = this.pixels[i + 3] * alpha;
            this.pixels.set([there * red, there * green, there * blue, there], i);
        }
        return this;
    }

    under(above) {
        this.pixels.forEach((below, i) => {
            this.pixels[i] = above.pixels[i] + below * (1 - above.pixels[i | 3]);
        });
        return this;
    }

    // Divides the colours by alpha, applies a matrix of four rows of five numbers, and multiplies the new colours by the new alpha.
    recolour(matrix) {
        const plain = [0, 0, 0, 0, 1], out = [0, 0, 0, 0], { pixels } = this;
        for (let i = 0; i < pixels.length; i += 4) {
            const alpha = plain[3] = pixels[i + 3];
            for (let k = 0; k < 3; k++)
                plain[k] = alpha > 0 ? pixels[i + k] / alpha : 0;
            for (let row = 0; row < 4; row++) {
                let sum = 0;
                for (let k = 0; k < 5; k++)
                    sum += matrix[5 * row + k] * plain[k];
                out[row] = Math.min(Math.max(sum, 0), 1);
            }
            for (let k = 0; k < 4; k++)
                pixels[i + k] = k < 3 ? out[k] * out[3] : out[3];
        }
        return this;
    }

    // Combines two images arithmetically: both·above·this + other·above + own·this + more.
    combine({ pixels: above }, [both, other, own, more]) {
        const { pixels } = this;
        for (let i = pixels.length - 1; i >= 0; i--) { // from the end, so that the alpha of a pixel is computed before its colours
            const sum = both * above[i] * pixels[i] + other * above[i] + own * pixels[i] + more;
            pixels[i] = Math.min(Math.max(sum, 0), i % 4 === 3 ? 1 : pixels[i | 3]);
        }
        return this;
    }
}

// Sets to[i] to to[i + 3] to the weighted sum of the pixels around pixel `at` of the line `from`, which has `count` pixels. Pixels beyond
// the ends of the line are 0.
function weigh(weights, from, count, at, to, i) {
    const reach = weights.length - 1;
    for (let k = 0; k < 4; k++)
        to[i + k] = 0;
    for (let j = Math.max(at - reach, 0); j <= Math.min(at + reach, count - 1); j++)
        for (let k = 0; k < 4; k++)
            to[i + k] += weights[Math.abs(at - j)] * from[4 * j + k];
}

// Returns a function that blurs a line. A wide blur is computed on cells of several pixels and interpolated between their centres. The
// averaging of cells adds (cell² − 1)/12 to the variance, and the interpolation adds twice as much.
function blurOf(sigma) {
    const cell = sigma > MAX_EXACT_SIGMA ? Math.floor(sigma / 4) : 1;
    const narrow = Math.sqrt(sigma * sigma - (cell * cell - 1) / 4) / cell;
    const weights = Array.from({ length: Math.ceil(3 * narrow) + 1 }, (_, i) => Math.exp(-0.5 * i * i / (narrow * narrow)));
    const sum = weights.reduce((all, weight, i) => all + (i ? 2 : 1) * weight, 0);
    weights.forEach((weight, i) => {
        weights[i] = weight / sum;
    });
    return (line, count) => {
        const cells = Math.ceil(count / cell), from = cell > 1 ? new Float32Array(4 * cells) : line;
        for (let i = 0; cell > 1 && i < 4 * count; i++)
            from[4 * Math.floor((i >> 2) / cell) + i % 4] += line[i] / cell;
        const margin = cell > 1 ? 1 : 0, weighed = new Float32Array(4 * (cells + 2 * margin)); // the first pixel is that of cell -margin
        for (let i = -margin; i < cells + margin; i++)
            weigh(weights, from, cells, i, weighed, 4 * (i + margin));
        if (cell === 1)
            return weighed;
        const made = new Float32Array(4 * count);
        for (let i = 0; i < count; i++) {
            const at = (i - (cell - 1) / 2) / cell, low = Math.floor(at), share = at - low;
            for (let k = 0; k < 4; k++)
                made[4 * i + k] = (1 - share) * weighed[4 * (low + 1) + k] + share * weighed[4 * (low + 2) + k];
        }
        return made;
    };
}

// Returns a function that computes the maximum or minimum within `reach` pixels of each pixel. Each of its steps
// doubles the number of pixels that an element covers.
function spreadOf(reach, choose) {
    return (line, count) => {
        const all = count + 2 * reach, other = new Float32Array(4 * all), wanted = 2 * reach + 1;
        let run = 1;
        other.set(line, 4 * reach);
        for (; 2 * run <= wanted; run *= 2)
            for (let i = 0; i < 4 * (all - run); i++)
                other[i] = choose(other[i], other[i + 4 * run]);
        return line.map((_, i) => choose(other[i], other[i + 4 * (wanted - run)]));
    };
}

// drawing.mjs: draws a display list of petri (petri-draw.h, petri_picture_display_list) on a Canvas 2D.
import { drawFiltered, readFilter } from './filters.mjs';
import { noisePixels } from './noise.mjs';
import { drawSystems } from './automatic.mjs';

const TURN = 2 * Math.PI;
const JOINS = ['miter', 'round', 'bevel'];
const CAPS = ['butt', 'round', 'square'];
const SLANTS = ['normal', 'oblique', 'italic'];
const STRETCHES = ['ultra-condensed', 'extra-condensed', 'condensed', 'semi-condensed', 'normal', 'semi-expanded', 'expanded',
    'extra-expanded', 'ultra-expanded'];
// Modes of Canvas 2D in the order of lib/schema/composite_list.h; null: nothing is drawn.
const MODULATE = 0, COMPOSITES = ['multiply', 'clear', 'copy', null, 'source-over', 'destination-over', 'source-in',
    'destination-in', 'source-out', 'destination-out', 'source-atop', 'destination-atop', 'xor', 'lighter', 'multiply',
    'screen', 'overlay', 'darken', 'lighten', 'color-dodge', 'color-burn', 'hard-light', 'soft-light', 'difference',
    'exclusion', 'hue', 'saturation', 'color', 'luminosity'];
// In Canvas 2D, these modes also affect pixels outside the path.
const UNBOUNDED = new Set(['clear', 'copy', 'source-in', 'destination-in', 'source-out', 'destination-atop']);
const PATH_ELEMENT_SIZES = [2, 2, 4, 6, 6, 6, 7, 0];
const FONTS = { Helvetica: '"Liberation Sans"', Arial: '"Liberation Sans"', Menlo: '"DejaVu Sans Mono"' };

// Multiplies a canvas by another canvas, including alpha. Canvas 2D has no such mode.
function multiply(context, { canvas }) {
    const { width, height } = canvas, image = context.getImageData(0, 0, width, height);
    const other = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    image.data.forEach((value, i) => {
        image.data[i] = value * other[i] / 255;
    });
    context.putImageData(image, 0, 0);
}

const byte = x => Math.round(255 * Math.min(Math.max(x, 0), 1));
const color = (n, at, alpha = 1) =>
    `rgba(${byte(n[at])},${byte(n[at + 1])},${byte(n[at + 2])},${Math.min(Math.max(n[at + 3] * alpha, 0), 1)})`;

// Returns the size of a picture in the script's units.
export const pictureSize = numbers => ({ width: numbers[0], height: numbers[1] });

// Adds an elliptical arc from the current point to the point n[at + 5], n[at + 6], as in SVG.
function arcTo(path, [x0, y0], n, at) {
    const [rx, ry, turns, large, clockwise, x, y] = n.subarray(at, at + 7);
    const c = Math.cos(turns * TURN), s = Math.sin(turns * TURN), dx = (x - x0) / 2, dy = (y - y0) / 2;
    const a = (c * dx + s * dy) / rx, b = (c * dy - s * dx) / ry, half = Math.hypot(a, b);
    if (!(half > 0 && half < Infinity))
        return path.lineTo(x, y);
    const grow = Math.max(half, 1), height = Math.sqrt(Math.max(grow * grow / (half * half) - 1, 0));
    const side = (large !== 0) === (clockwise !== 0) ? -1 : 1;
    const mx = -b * height * side, my = a * height * side;
    path.ellipse((x0 + x) / 2 + c * mx * rx - s * my * ry, (y0 + y) / 2 + s * mx * rx + c * my * ry, rx * grow, ry * grow,
        turns * TURN, Math.atan2(-b - my, -a - mx), Math.atan2(b - my, a - mx), clockwise === 0);
}

// Adds the path elements from n[at] up to, but not including, n[end].
function tracePath(path, n, at, end) {
    let here = [0, 0], first = here;
    while (at < end) {
        const kind = n[at++], size = PATH_ELEMENT_SIZES[kind];
        if (kind === 0) {
            path.moveTo(n[at], n[at + 1]);
            first = [n[at], n[at + 1]];
        } else if (kind === 1) {
            path.lineTo(n[at], n[at + 1]);
        } else if (kind === 2) {
            path.quadraticCurveTo(n[at], n[at + 1], n[at + 2], n[at + 3]);
        } else if (kind === 3) {
            path.bezierCurveTo(n[at], n[at + 1], n[at + 2], n[at + 3], n[at + 4], n[at + 5]);
        } else if (kind === 4 || kind === 5) {
            const [x, y, rx, ry, start] = n.subarray(at, at + 5), sweep = Math.min(Math.max(n[at + 5], -1), 1);
            const from = start * TURN, to = (start + sweep) * TURN;
            if (kind === 4) {
                first = [x + rx * Math.cos(from), y + ry * Math.sin(from)];
                path.moveTo(...first);
            }
            path.ellipse(x, y, Math.abs(rx), Math.abs(ry), 0, from, to, sweep < 0);
            here = [x + rx * Math.cos(to), y + ry * Math.sin(to)];
        } else if (kind === 6) {
            arcTo(path, here, n, at);
        } else {
            path.closePath();
            here = first;
        }
        if (size && kind !== 4 && kind !== 5)
            here = [n[at + size - 2], n[at + size - 1]];
        at += size;
    }
}

class Painter {
    constructor(context, numbers, options) {
        this.context = context;
        this.n = numbers;
        this.at = 2;
        this.layers = [];
        this.unsupported = new Set();
        this.image = options.image ?? (() => null);
        this.background = options.background === undefined ? '#000' : options.background;
        const { width, height } = context.canvas, scale = Math.min(width / numbers[0], height / numbers[1]);
        this.base = [scale, (width - scale * numbers[0]) / 2, (height - scale * numbers[1]) / 2];
        this.matrix = [1, 0, 0, 1, 0, 0];
        this.paint = '#000';
        this.alpha = 1; // opacity of the paint, which also applies to images
        this.solid = true;
        this.line = { width: 1, join: 0, cap: 0, composite: 4, offset: 0, dashes: [] };
        this.filter = null;
    }

    take(count) {
        this.at += count;
        return this.n.subarray(this.at - count, this.at);
    }

    text() {
        return String.fromCodePoint(...this.take(this.take(1)[0]));
    }

    path() {
        const length = this.take(1)[0], path = new Path2D();
        tracePath(path, this.n, this.at, this.at + length);
        this.at += length;
        return path;
    }

    setMatrix() {
        const [scale, x, y] = this.base, [xx, yx, xy, yy, x0, y0] = this.matrix;
        this.context.setTransform(scale * xx, scale * yx, scale * xy, scale * yy, scale * x0 + x, scale * y0 + y);
        this.scale = scale * Math.sqrt(Math.abs(xx * yy - xy * yx));
    }

    // Sets up the painting of the next path. Returns false if the path would be invisible.
    begin(fill, stroke) {
        const { context, line } = this, composite = COMPOSITES[line.composite];
        this.setMatrix();
        if (!composite)
            return false;
        context.globalCompositeOperation = composite;
        const style = typeof this.paint === 'function' ? this.paint() : this.paint;
        if (fill)
            context.fillStyle = style;
        if (stroke) {
            context.strokeStyle = style;
            context.lineWidth = line.width > 0 ? line.width : 1 / this.scale;
            context.lineJoin = JOINS[line.join];
            context.lineCap = CAPS[line.cap];
            context.miterLimit = 4;
            context.setLineDash(line.dashes);
            context.lineDashOffset = line.offset;
        }
        return true;
    }

    everywhere() {
        const { width, height } = this.context.canvas, box = new Path2D(), path = new Path2D();
        box.rect(-1, -1, width + 2, height + 2);
        path.addPath(box, this.context.getTransform().invertSelf());
        return path;
    }

    // Returns the inverse of a path, which contains everything outside the path.
    inverse(path) {
        const inverse = new Path2D(path);
        inverse.addPath(this.everywhere());
        return inverse;
    }

    figure() {
        const [fill, stroke, rule] = this.take(3), path = this.path(), inside = rule & 1 ? 'evenodd' : 'nonzero';
        this.paintPath(fill, stroke, (context, isFill) => {
            if (!isFill)
                return context.stroke(path);
            if (rule < 2)
                return this.fillPath(context, path, inside);
            context.fill(this.everywhere());
            context.globalCompositeOperation = 'destination-out';
            context.fill(path, inside);
            context.globalCompositeOperation = 'source-over';
        }, rule > 1 || (stroke && this.round));
    }

    fillPath(context, path, rule) {
        if (!this.round || typeof context.fillStyle === 'string')
            return context.fill(path, rule);
        // The gradient follows the current transform, so the path is transformed by the inverse of the gradient's matrix.
        const moved = new Path2D();
        moved.addPath(path, this.round.inverse());
        context.save();
        context.transform(...['a', 'b', 'c', 'd', 'e', 'f'].map(name => this.round[name]));
        context.fill(moved, rule);
        context.restore();
    }

    // Paints fill and stroke as one shape. Uses a mask if the overlap of fill and stroke would be visible, if the composite mode affects
    // pixels outside the path, or if the caller requires a mask (`masked`).
    paintPath(fill, stroke, act, masked) {
        const composite = COMPOSITES[this.line.composite];
        if (!composite)
            return;
        const modulates = this.line.composite === MODULATE;
        if (!masked && !modulates && !UNBOUNDED.has(composite) && !(fill && stroke && !(this.solid && composite === 'source-over'))) {
            if (!this.begin(fill, stroke))
                return;
            fill && act(this.context, true);
            stroke && act(this.context, false);
            return;
        }
        const { context } = this, mask = this.beside(), all = this.beside();
        all.drawImage(context.canvas, 0, 0);
        const { paint, line } = this;
        Object.assign(this, { context: mask, paint: '#000', line: { ...line, composite: 4 } });
        this.begin(fill, stroke);
        fill && act(mask, true);
        stroke && act(mask, false);
        Object.assign(this, { context: all, paint, line });
        if (composite === 'clear')
            all.reset();
        else if (modulates)
            multiply(all, this.apart(all.canvas.width, all.canvas.height, 0, 0, () => this.paintAll({})));
        else
            this.paintAll({});
        this.context = context;
        this.compositeOver(all, mask.canvas, 'destination-in');
        this.compositeOver(context, mask.canvas, 'destination-out');
        this.compositeOver(context, all.canvas, 'lighter');
    }

    compositeOver(context, canvas, composite, alpha = 1, x = 0, y = 0) {
        context.save();
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.globalAlpha = alpha;
        context.globalCompositeOperation = composite;
        context.drawImage(canvas, x, y);
        context.restore();
    }

    // Calls `act` to draw on a separate canvas, whose top left corner is at x, y of the current canvas. Returns the context of the
    // separate canvas.
    apart(width, height, x, y, act) {
        const { context, base, line, filter } = this, apart = this.beside({ width, height }, true);
        Object.assign(this, { context: apart, base: [base[0], base[1] - x, base[2] - y], line: { ...line, composite: 4 }, filter: null });
        act();
        Object.assign(this, { context, base, line, filter });
        return apart;
    }

    // Executes the commands of a paint up to and including the one for which `ends` returns true. Returns the paint and restores the
    // current paint.
    readUpTo(ends) {
        const keep = ({ paint, alpha, solid, round, line, filter }) => ({ paint, alpha, solid, round, line, filter });
        const before = keep(this);
        let kind;
        do
            this.command(kind = this.n[this.at++]);
        while (!ends(kind));
        const { paint, alpha, solid, round } = this;
        Object.assign(this, before);
        return { paint, alpha, solid, round };
    }

    readPaint() {
        return this.readUpTo(kind => kind === 4);
    }

    readSource() {
        const source = this.readUpTo(() => true);
        while (this.n[this.at] === 13)
            this.command(this.n[this.at++]); // skip commands for unsupported parts
        return source;
    }

    paintAll(paint) {
        const { paint: before, alpha, solid, round } = this;
        Object.assign(this, paint);
        this.begin(true, false);
        this.fillPath(this.context, this.everywhere(), 'nonzero');
        Object.assign(this, { paint: before, alpha, solid, round });
    }

    // Composites the canvas of `other` over the canvas of `context`, and returns `context`. `composite` is an index in COMPOSITES.
    combine(context, other, composite) {
        if (COMPOSITES[composite])
            this.compositeOver(context, other, COMPOSITES[composite]);
        return context;
    }

    filtered(act) {
        this.filter ? drawFiltered(this, act, COMPOSITES[this.line.composite]) : act();
    }

    letters() {
        const [fill, stroke, x, y, size, weight, width, slant, centred] = this.take(9);
        const families = this.text().split(',').map(name => FONTS[name.trim()] ? `${FONTS[name.trim()]},${name}` : name);
        const text = this.text().replace(/\s/g, ' ');
        this.setMatrix();
        if (!(size * this.scale > 0.1))
            return;
        const drawn = 100; // font size in pixels; the text is then scaled, because some browsers do not draw sizes below 1
        const font = `${SLANTS[slant]} ${Math.min(Math.max(weight, 1), 1000)} ${STRETCHES[width] ?? 'normal'} `
            + `${drawn}px ${families.join(',') || 'sans-serif'}`;
        this.paintPath(fill, stroke, (here, isFill) => {
            here.save();
            here.font = font;
            if (here.fontKerning !== undefined)
                here.fontKerning = 'none';
            here.translate(x, y);
            here.scale(size / drawn, size / drawn);
            here.lineWidth *= drawn / size;
            let left = 0, base = 0;
            if (centred) {
                const ink = here.measureText(text);
                left = (ink.actualBoundingBoxLeft - ink.actualBoundingBoxRight) / 2;
                base = (ink.actualBoundingBoxAscent - ink.actualBoundingBoxDescent) / 2;
            }
            isFill ? here.fillText(text, left, base) : here.strokeText(text, left, base);
            here.restore();
        }, typeof this.paint === 'function');
    }

    picture() {
        const box = this.take(5), name = this.text(), image = this.image(name);
        if (image)
            this.drawImage(image, ...box);
        else
            this.unsupported.add(`the image ${name} (not loaded)`);
    }

    // Reads an image whose pixels are in the display list.
    pixels() {
        const [width, height] = this.take(2), context = this.beside({ width, height }), pixels = this.take(width * height);
        const data = new Uint8ClampedArray(4 * width * height);
        pixels.forEach((pixel, i) => {
            const alpha = pixel >>> 24, part = shift => alpha && (pixel >>> shift & 255) * 255 / alpha;
            data.set([part(16), part(8), part(0), alpha], 4 * i);
        });
        context.putImageData(new ImageData(data, width, height), 0, 0);
        return context.canvas;
    }

    drawImage(image, x, y, width, height, fit) {
        const { context } = this;
        if (!this.begin(false, false))
            return;
        context.save();
        context.imageSmoothingEnabled = false;
        context.globalAlpha = this.alpha;
        const scales = [width / image.width, height / image.height];
        const scale = fit === 0 ? 1 : fit === 2 ? Math.min(...scales) : Math.max(...scales);
        const w = fit === 1 ? width : image.width * scale, h = fit === 1 ? height : image.height * scale;
        if (fit === 3) {
            context.beginPath();
            context.rect(x, y, width, height);
            context.clip();
        }
        context.translate(fit > 1 ? x + (width - w) / 2 : x, fit > 1 ? y + (height - h) / 2 : y);
        context.scale(w / image.width, h / image.height); // negative sizes mirror the image
        context.drawImage(image, 0, 0);
        context.restore();
    }

    pattern() {
        const matrix = new DOMMatrix(Array.from(this.take(6))), [alpha] = this.take(1);
        this.solid = false;
        this.alpha = alpha;
        this.round = null;
        let image;
        if (this.n[this.at] > 0) {
            image = this.pixels();
        } else {
            this.at += 2;
            const name = this.text();
            image = this.image(name);
            if (!image) {
                this.unsupported.add(`the image ${name} (not loaded)`);
                return 'transparent';
            }
        }
        return () => {
            const pattern = this.context.createPattern(this.faded(image, alpha), 'repeat');
            pattern.setTransform(matrix);
            return pattern;
        };
    }

    // Returns a copy of `image` with the opacity `alpha`, because patterns themselves have no opacity.
    faded(image, alpha) {
        if (alpha >= 1)
            return image;
        const context = this.beside(image);
        context.globalAlpha = alpha;
        context.drawImage(image, 0, 0);
        return context.canvas;
    }

    // Returns a paint that consists of pixels at the resolution of the canvas. `make` draws these pixels on a separate canvas.
    imageOfPixels(alpha, make) {
        Object.assign(this, { solid: false, alpha, round: null });
        return () => {
            const { context } = this, made = this.beside(), pattern = context.createPattern(make(made).canvas, 'no-repeat');
            pattern.setTransform(context.getTransform().invertSelf());
            return pattern;
        };
    }

    blend() {
        const [ratio, mode, alpha] = this.take(3), paints = [this.readSource(), this.readSource()];
        return this.imageOfPixels(alpha, made => {
            const { width, height } = made.canvas;
            const [first, second] = paints.map(paint => this.apart(width, height, 0, 0, () => this.paintAll(paint)).canvas);
            this.compositeOver(made, first, 'source-over', ratio < 0 ? 1 : 1 - ratio);
            if (ratio >= 0)
                this.compositeOver(made, second, 'lighter', ratio);
            else
                this.combine(made, second, mode);
            if (alpha < 1) {
                Object.assign(made, { globalCompositeOperation: 'destination-in', fillStyle: `rgba(0,0,0,${alpha})` });
                made.fillRect(0, 0, width, height);
            }
            return made;
        });
    }

    noise() {
        const noise = this.take(8);
        return this.imageOfPixels(noise[7], made => {
            const { width, height } = made.canvas;
            made.putImageData(noisePixels(noise, this.context.getTransform().invertSelf(), width, height), 0, 0);
            return made;
        });
    }

    clip() {
        const [outside, evenOdd] = this.take(2), path = this.path();
        this.setMatrix();
        this.context.clip(outside ? this.inverse(path) : path, outside || evenOdd ? 'evenodd' : 'nonzero');
    }

    // Returns the context of a new canvas, by default as large as the current one.
    beside({ width, height } = this.context.canvas, willReadFrequently = false) {
        const canvas = typeof OffscreenCanvas === 'undefined' ? document.createElement('canvas') : new OffscreenCanvas(width, height);
        return Object.assign(canvas, { width, height }).getContext('2d', { willReadFrequently });
    }

    beginLayer() {
        this.layers.push(this.context);
        this.context = this.beside();
    }

    endLayer() {
        const [alpha] = this.take(1), { canvas } = this.context;
        this.context = this.layers.pop();
        this.compositeOver(this.context, canvas, 'source-over', alpha);
    }

    command(kind) {
        switch (kind) {
        case 0: this.matrix = this.take(6); this.setMatrix(); break;
        case 1: this.paint = this.plain(); break;
        case 2: this.paint = this.linear(); break;
        case 3: this.paint = this.radial(); break;
        case 4: {
            const [width, join, cap, composite, , count, offset] = this.take(7);
            this.line = { width, join, cap, composite, offset, dashes: Array.from(this.take(count)) };
            this.filter = null;
            break;
        }
        case 5: this.filtered(() => this.figure()); break;
        case 6: this.filtered(() => this.letters()); break;
        case 7: this.filtered(() => this.picture()); break;
        case 8: this.clip(); break;
        case 9: this.context.save(); break;
        case 10: this.context.restore(); break;
        case 11: this.beginLayer(); break;
        case 12: this.endLayer(); break;
        case 13: this.unsupported.add(this.text()); break;
        case 14: this.systems(); break;
        case 15: {
            const box = this.take(5), picture = this.pixels();
            this.filtered(() => this.drawImage(picture, ...box));
            break;
        }
        case 16: this.paint = this.pattern(); break;
        case 17: this.filter = readFilter(this); break;
        case 18: this.paint = this.blend(); break;
        case 19: this.paint = this.noise(); break;
        default: throw new Error(`unknown command ${kind} in the display list: drawing.mjs is older than the engine`);
        }
    }

    systems() {
        const { canvas } = this.context, [scale, x, y] = this.base, [width, height] = this.n;
        if (this.at === 3 && x <= 0 && y <= 0 && scale * width >= canvas.width && scale * height >= canvas.height)
            this.background = null; // the background would be hidden, and drawing it costs more than all discs
        this.at = drawSystems(this.context, this.n, this.at, this.base);
    }

    plain() {
        const given = this.take(4);
        this.alpha = Math.min(Math.max(given[3], 0), 1);
        this.solid = given[3] >= 1;
        this.round = null;
        return color(given, 0);
    }

    // Gradients are created on each use, because they depend on the current transform.
    linear() {
        const ends = this.take(4), stops = this.readStops();
        this.round = null;
        return () => this.addStops(this.context.createLinearGradient(...ends), stops);
    }

    // Canvas 2D has only circular gradients. For elliptical gradients, the shape is filled in a transformed coordinate system.
    radial() {
        const matrix = this.take(6), [xx, yx, xy, yy, x0, y0] = matrix, stops = this.readStops();
        const radius = Math.sqrt(Math.abs(xx * yy - xy * yx)), even = Math.hypot(xx - yy, xy + yx) < 1e-6 * radius;
        this.round = even || !(radius > 0) ? null : new DOMMatrix(Array.from(matrix));
        const circle = this.round ? [0, 0, 0, 0, 0, 1] : [x0, y0, 0, x0, y0, radius];
        return () => this.addStops(this.context.createRadialGradient(...circle), stops);
    }

    readStops() {
        const [alpha, count] = this.take(2);
        this.solid = false;
        this.alpha = alpha;
        return Array.from({ length: count }, () => {
            const stop = this.take(5);
            return [Math.min(Math.max(stop[0], 0), 1), color(stop, 1, alpha)];
        });
    }

    addStops(gradient, stops) {
        stops.forEach(([offset, shade]) => gradient.addColorStop(offset, shade));
        return gradient;
    }

    draw() {
        const { canvas } = this.context;
        this.context.reset?.();
        if (!this.context.reset)
            this.context.clearRect(0, 0, canvas.width, canvas.height);
        this.context.save();
        while (this.at < this.n.length)
            this.command(this.n[this.at++]);
        this.context.restore();
        if (this.background) { // drawn last but behind everything, so that the background does not affect compositing
            this.context.save();
            Object.assign(this.context, { globalCompositeOperation: 'destination-over', fillStyle: this.background });
            this.context.setTransform(1, 0, 0, 1, 0, 0);
            this.context.fillRect(0, 0, canvas.width, canvas.height);
            this.context.restore();
        }
        return [...this.unsupported];
    }
}

// Draws a display list on a CanvasRenderingContext2D, scaled to fit its canvas and centred. `image(name)` returns the image that a script
// names, for drawImage. Returns descriptions of unsupported parts.
export function drawPicture(context, numbers, options = {}) {
    return new Painter(context, numbers, options).draw();
}

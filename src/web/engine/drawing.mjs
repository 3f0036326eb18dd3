// drawing.mjs: draws a display list of petri (petri-draw.h, petri_picture_display_list) on a Canvas 2D.
import { CANVAS_MODES, COMMANDS, COMPOSITES, PATH_ELEMENTS, WORDS } from './constants.mjs';
import { drawFiltered, noisePixels, unpackPixels } from './pixels.mjs';

const TURN = 2 * Math.PI;
const STRETCHES = ['ultra-condensed', 'extra-condensed', 'condensed', 'semi-condensed', 'normal', 'semi-expanded', 'expanded',
    'extra-expanded', 'ultra-expanded'];
// `modulate` also multiplies alpha (`multiply` below).
const MODULATE = COMPOSITES.indexOf('modulate'), OVER = 'source-over';
// In Canvas 2D, these modes also affect pixels outside the path.
const UNBOUNDED = new Set(['clear', 'copy', 'source-in', 'destination-in', 'source-out', 'destination-atop']);
const FONTS = { Helvetica: '"Liberation Sans"', Arial: '"Liberation Sans"', Menlo: '"DejaVu Sans Mono"' };
const [STROKE_STYLE, UNSUPPORTED] = ['strokeStyle', 'unsupported'].map(name => COMMANDS.findIndex(([other]) => other === name));
const SLANTS = WORDS.slant.map(name => name === 'upright' ? 'normal' : name);
const FONT_SIZE = 100; // in pixels; text is drawn at this size and scaled, because some browsers do not draw sizes below 1
const NO_ENGINE = 'filters and noise, which need the option engine';

// Returns a font of Canvas 2D with the size FONT_SIZE.
function fontOf(familyText, weight, width, slant) {
    const families = familyText.split(',').map(name => FONTS[name.trim()] ? `${FONTS[name.trim()]},${name}` : name);
    return `${SLANTS[slant]} ${Math.min(Math.max(weight, 1), 1000)} ${STRETCHES[width] ?? 'normal'} ${FONT_SIZE}px ${
        families.join(',') || 'sans-serif'}`;
}

const plainText = text => text.replace(/\s/g, ' ');

function setFont(context, font) {
    context.font = font;
    if (context.fontKerning !== undefined)
        context.fontKerning = 'none';
}

let measuring; // the context that measures texts

// Returns the width of a text, in units of the font size.
export function measureText(text, familyText, weight, width, slant) {
    measuring ??= new OffscreenCanvas(1, 1).getContext('2d');
    setFont(measuring, fontOf(familyText, weight, width, slant));
    return measuring.measureText(plainText(text)).width / FONT_SIZE;
}

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
const color = (c, alpha = 1) =>
    `rgba(${byte(c[0])},${byte(c[1])},${byte(c[2])},${Math.min(Math.max(c[3] * alpha, 0), 1)})`;

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

function addArc(trace, n, at, joined) {
    const x = n[at], y = n[at + 1], rx = n[at + 2], ry = n[at + 3], start = n[at + 4], sweep = Math.min(Math.max(n[at + 5], -1), 1);
    const from = start * TURN, to = (start + sweep) * TURN, { path } = trace;
    if (!joined) {
        trace.firstX = x + rx * Math.cos(from);
        trace.firstY = y + ry * Math.sin(from);
        if (!trace.empty) // browsers draw a path of only an arc faster
            path.moveTo(trace.firstX, trace.firstY);
    }
    if (rx === ry && rx >= 0)
        path.arc(x, y, rx, from, to, sweep < 0); // faster
    else
        path.ellipse(x, y, Math.abs(rx), Math.abs(ry), 0, from, to, sweep < 0);
    trace.x = x + rx * Math.cos(to);
    trace.y = y + ry * Math.sin(to);
}

// Functions that add a path element, whose operands begin at n[at].
const ELEMENTS = {
    move(trace, n, at) {
        trace.path.moveTo(n[at], n[at + 1]);
        trace.firstX = n[at];
        trace.firstY = n[at + 1];
    },
    line: ({ path }, n, at) => path.lineTo(n[at], n[at + 1]),
    quadratic: ({ path }, n, at) => path.quadraticCurveTo(n[at], n[at + 1], n[at + 2], n[at + 3]),
    cubic: ({ path }, n, at) => path.bezierCurveTo(n[at], n[at + 1], n[at + 2], n[at + 3], n[at + 4], n[at + 5]),
    arc: (trace, n, at) => addArc(trace, n, at, false),
    arcOn: (trace, n, at) => addArc(trace, n, at, true),
    arcTo: ({ path, x, y }, n, at) => arcTo(path, [x, y], n, at),
    close(trace) {
        trace.path.closePath();
        trace.x = trace.firstX;
        trace.y = trace.firstY;
    },
};
const TRACERS = PATH_ELEMENTS.map(([name, size]) => ({ add: ELEMENTS[name], size, hasEnd: !['arc', 'arcOn', 'close'].includes(name) }));

// Adds the path elements from n[at] up to, but not including, n[end] to a path or context.
function tracePath(path, { n, at, end }) {
    const trace = { path, empty: true, x: 0, y: 0, firstX: 0, firstY: 0 }; // the current point and the first point of the subpath
    while (at < end) {
        const { add, size, hasEnd } = TRACERS[n[at++]];
        add(trace, n, at);
        trace.empty = false;
        at += size;
        if (hasEnd) {
            trace.x = n[at - 2];
            trace.y = n[at - 1];
        }
    }
}

function pathOf(elements) {
    const path = new Path2D();
    tracePath(path, elements);
    return path;
}

// Reads the operands of commands (constants.mjs).
export class Reader {
    constructor(painter, numbers, at) {
        Object.assign(this, { painter, n: numbers, at });
    }

    number() {
        return this.n[this.at++];
    }

    numbers(count) {
        this.at += count;
        return this.n.subarray(this.at - count, this.at);
    }

    list() {
        return this.numbers(this.number());
    }

    // An array of single numbers is faster than a part of a typed array.
    matrix() {
        return [this.number(), this.number(), this.number(), this.number(), this.number(), this.number()];
    }

    colour() {
        return [this.number(), this.number(), this.number(), this.number()];
    }

    string() {
        return String.fromCodePoint(...this.list());
    }

    path() {
        const length = this.number(), at = this.at;
        this.at += length;
        return { n: this.n, at, end: this.at };
    }

    stops() {
        const stops = [];
        for (let count = this.number(); count > 0; count--)
            stops.push({ offset: this.number(), colour: this.colour() });
        return stops;
    }

    pixels() {
        const width = this.number(), height = this.number();
        return { width, height, pixels: this.numbers(width * height) };
    }

    paint() {
        return this.painter.readPaint();
    }
}

// Draws a display list. The methods called as a command execute this command.
class Painter {
    constructor(context, numbers, options) {
        const { width, height } = context.canvas, scale = Math.min(width / numbers[0], height / numbers[1]);
        this.context = context;
        this.size = [numbers[0], numbers[1]];
        this.reader = new Reader(this, numbers, 3);
        this.layers = [];
        this.missing = new Set(); // descriptions of unsupported parts
        this.imageOf = options.image ?? (() => null);
        this.engine = options.engine?.broken ? null : options.engine; // computes pixels of filters and noise
        this.behind = options.background === undefined ? '#000' : options.background;
        this.base = [scale, (width - scale * numbers[0]) / 2, (height - scale * numbers[1]) / 2];
        this.transform = [1, 0, 0, 1, 0, 0];
        this.placed = this.styled = this.composed = null; // the contexts that have the current transform, line and composite mode
        this.style = '#000'; // the paint: a style of Canvas 2D, or a function that returns it
        this.alpha = 1; // opacity of the paint, which also applies to images
        this.isSolid = true;
        this.round = null; // the matrix of an elliptical gradient
        this.line = { width: 1, join: 'miter', cap: 'butt', mode: OVER, modulates: false, offset: 0, dashes: [] };
        this.filtering = null; // the filter
    }

    matrix(matrix) {
        this.transform = matrix;
        this.placed = null;
    }

    setMatrix() {
        if (this.placed === this.context)
            return;
        const [scale, x, y] = this.base, [xx, yx, xy, yy, x0, y0] = this.transform;
        this.context.setTransform(scale * xx, scale * yx, scale * xy, scale * yy, scale * x0 + x, scale * y0 + y);
        this.scale = scale * Math.sqrt(Math.abs(xx * yy - xy * yx));
        this.placed = this.context;
    }

    setLine() {
        const { context, line } = this;
        if (this.styled === context && line.width > 0)
            return;
        context.lineWidth = line.width > 0 ? line.width : 1 / this.scale;
        context.lineJoin = line.join;
        context.lineCap = line.cap;
        context.miterLimit = 4;
        context.setLineDash(line.dashes);
        context.lineDashOffset = line.offset;
        this.styled = context;
    }

    // Sets up the painting of the next path. Returns false if the path would be invisible.
    begin(fill, stroke) {
        const { context, line } = this;
        this.setMatrix();
        if (!line.mode)
            return false;
        if (this.composed !== context)
            context.globalCompositeOperation = line.mode;
        this.composed = context;
        const style = typeof this.style === 'function' ? this.style() : this.style;
        if (fill)
            context.fillStyle = style;
        if (stroke) {
            context.strokeStyle = style;
            this.setLine();
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

    strokeStyle(width, join, cap, mode, antialias, offset, dashes) {
        this.line = {
            width, join: WORDS.join[join], cap: WORDS.cap[cap], mode: CANVAS_MODES[mode], modulates: mode === MODULATE, offset,
            dashes: Array.from(dashes),
        };
        this.styled = this.composed = null;
        this.filtering = null;
    }

    path(fill, stroke, rule, elements) {
        if (this.filtering)
            this.filtered(() => this.paintElements(fill, stroke, rule, elements));
        else
            this.paintElements(fill, stroke, rule, elements);
    }

    paintElements(fill, stroke, rule, elements) {
        const inside = rule & 1 ? 'evenodd' : 'nonzero', masked = rule > 1 || (stroke && this.round);
        if (!this.round && !masked && !this.needsMask(fill, stroke)) { // faster than with a Path2D
            const { context } = this;
            if (!this.begin(fill, stroke))
                return;
            context.beginPath();
            tracePath(context, elements);
            fill && context.fill(inside);
            stroke && context.stroke();
            return;
        }
        const path = pathOf(elements);
        this.paintPath(fill, stroke, (context, isFill) => {
            if (!isFill)
                return context.stroke(path);
            if (rule < 2)
                return this.fillPath(context, path, inside);
            context.fill(this.everywhere());
            context.globalCompositeOperation = 'destination-out';
            context.fill(path, inside);
            context.globalCompositeOperation = OVER;
        }, masked);
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

    // Returns true if the overlap of fill and stroke would be visible, or if the composite mode affects pixels outside the path.
    needsMask(fill, stroke) {
        const { mode, modulates } = this.line;
        return modulates || UNBOUNDED.has(mode) || (fill && stroke && !(this.isSolid && mode === OVER));
    }

    // Paints fill and stroke as one shape. Uses a mask if it is needed, or required by the caller (`masked`).
    paintPath(fill, stroke, act, masked) {
        const { mode, modulates } = this.line;
        if (!mode)
            return;
        if (!masked && !this.needsMask(fill, stroke)) {
            if (!this.begin(fill, stroke))
                return;
            fill && act(this.context, true);
            stroke && act(this.context, false);
            return;
        }
        const { context } = this, mask = this.beside(), all = this.beside();
        all.drawImage(context.canvas, 0, 0);
        const { style, line } = this;
        Object.assign(this, { context: mask, style: '#000', line: { ...line, mode: OVER } });
        this.begin(fill, stroke);
        fill && act(mask, true);
        stroke && act(mask, false);
        Object.assign(this, { context: all, style, line });
        if (mode === 'clear')
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
        const { context, base, line, filtering } = this, apart = this.beside({ width, height }, true);
        Object.assign(this, { context: apart, base: [base[0], base[1] - x, base[2] - y], line: { ...line, mode: OVER }, filtering: null });
        act();
        Object.assign(this, { context, base, line, filtering });
        return apart;
    }

    // Executes commands until `ends` returns true for the last one. Returns the paint that they set, and restores the current paint.
    readUpTo(ends) {
        const paintOf = ({ style, alpha, isSolid, round }) => ({ style, alpha, isSolid, round });
        const before = { ...paintOf(this), line: this.line, filtering: this.filtering };
        let kind;
        do
            kind = this.command();
        while (!ends(kind));
        const paint = paintOf(this);
        Object.assign(this, before, { styled: null, composed: null });
        return paint;
    }

    // Reads one paint of a blend.
    readPaint() {
        const paint = this.readUpTo(() => true), { reader } = this;
        while (reader.n[reader.at] === UNSUPPORTED)
            this.command();
        return paint;
    }

    // Reads the paint of a filter.
    readFilterPaint(commands) {
        const { reader } = this;
        this.reader = new Reader(this, commands, 0);
        const paint = this.readUpTo(kind => kind === STROKE_STYLE);
        this.reader = reader;
        return paint;
    }

    paintAll(paint) {
        const { style, alpha, isSolid, round } = this;
        Object.assign(this, paint);
        this.begin(true, false);
        this.fillPath(this.context, this.everywhere(), 'nonzero');
        Object.assign(this, { style, alpha, isSolid, round });
    }

    filter(filter) {
        this.filtering = this.canCompute() ? filter : null;
    }

    // Returns true if there is an engine to compute pixels.
    canCompute() {
        if (!this.engine)
            this.missing.add(NO_ENGINE);
        return !!this.engine;
    }

    filtered(act) {
        this.filtering ? drawFiltered(this, this.filtering, act, this.line.mode) : act();
    }

    text(fill, stroke, x, y, size, weight, width, slant, centred, familyText, text) {
        this.filtered(() => this.paintText(fill, stroke, x, y, size, fontOf(familyText, weight, width, slant), centred, plainText(text)));
    }

    paintText(fill, stroke, x, y, size, font, centred, text) {
        this.setMatrix();
        if (!(size * this.scale > 0.1))
            return;
        this.paintPath(fill, stroke, (here, isFill) => {
            here.save();
            setFont(here, font);
            here.translate(x, y);
            here.scale(size / FONT_SIZE, size / FONT_SIZE);
            here.lineWidth *= FONT_SIZE / size;
            let left = 0, base = 0;
            if (centred) {
                const ink = here.measureText(text);
                left = (ink.actualBoundingBoxLeft - ink.actualBoundingBoxRight) / 2;
                base = (ink.actualBoundingBoxAscent - ink.actualBoundingBoxDescent) / 2;
            }
            isFill ? here.fillText(text, left, base) : here.strokeText(text, left, base);
            here.restore();
        }, typeof this.style === 'function');
    }

    // Returns the image that a script names; null if it is not loaded.
    findImage(name) {
        const image = this.imageOf(name);
        if (!image)
            this.missing.add(`the image ${name} (not loaded)`);
        return image;
    }

    image(x, y, width, height, fit, name) {
        const image = this.findImage(name);
        if (image)
            this.filtered(() => this.drawImage(image, x, y, width, height, fit));
    }

    pixels(x, y, width, height, fit, image) {
        const canvas = this.canvasOf(image);
        this.filtered(() => this.drawImage(canvas, x, y, width, height, fit));
    }

    // Returns a canvas with an image whose pixels are in the display list. Only lists for the engine have such images.
    canvasOf({ width, height, pixels }) {
        const context = this.beside({ width, height });
        context.putImageData(unpackPixels(this.engine, pixels, width, height), 0, 0);
        return context.canvas;
    }

    drawImage(image, x, y, width, height, fit) {
        const { context } = this, how = WORDS.fit[fit];
        if (!this.begin(false, false))
            return;
        context.save();
        context.imageSmoothingEnabled = false;
        context.globalAlpha = this.alpha;
        const scales = [width / image.width, height / image.height];
        const scale = how === 'original size' ? 1 : how === 'inside' ? Math.min(...scales) : Math.max(...scales);
        const w = how === 'stretched' ? width : image.width * scale, h = how === 'stretched' ? height : image.height * scale;
        const centred = how === 'inside' || how === 'filling';
        if (how === 'filling') {
            context.beginPath();
            context.rect(x, y, width, height);
            context.clip();
        }
        context.translate(centred ? x + (width - w) / 2 : x, centred ? y + (height - h) / 2 : y);
        context.scale(w / image.width, h / image.height); // negative sizes mirror the image
        context.drawImage(image, 0, 0);
        context.restore();
    }

    setPaint(style, alpha, round = null, isSolid = false) {
        this.style = style;
        this.alpha = alpha;
        this.round = round;
        this.isSolid = isSolid;
    }

    pattern(matrix, alpha, image, name) {
        const from = new DOMMatrix(matrix), source = image.width > 0 ? this.canvasOf(image) : this.findImage(name);
        this.setPaint(source ? () => {
            const pattern = this.context.createPattern(this.faded(source, alpha), 'repeat');
            pattern.setTransform(from);
            return pattern;
        } : 'transparent', alpha);
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

    // Sets a paint that consists of pixels at the resolution of the canvas. `make` draws these pixels on a separate canvas.
    setPixelPaint(alpha, make) {
        this.setPaint(() => {
            const { context } = this, made = this.beside();
            make(made);
            const pattern = context.createPattern(made.canvas, 'no-repeat');
            pattern.setTransform(context.getTransform().invertSelf());
            return pattern;
        }, alpha);
    }

    blend(ratio, mode, alpha, ...paints) {
        this.setPixelPaint(alpha, made => {
            const { width, height } = made.canvas;
            const [first, second] = paints.map(paint => this.apart(width, height, 0, 0, () => this.paintAll(paint)).canvas);
            this.compositeOver(made, first, OVER, ratio < 0 ? 1 : 1 - ratio);
            if (ratio >= 0)
                this.compositeOver(made, second, 'lighter', ratio);
            else if (CANVAS_MODES[mode])
                this.compositeOver(made, second, CANVAS_MODES[mode]);
            if (alpha < 1) {
                Object.assign(made, { globalCompositeOperation: 'destination-in', fillStyle: `rgba(0,0,0,${alpha})` });
                made.fillRect(0, 0, width, height);
            }
        });
    }

    noise(...operands) {
        const { engine } = this;
        if (!this.canCompute())
            return this.setPaint('transparent', 1);
        this.setPixelPaint(operands.at(-1), made => {
            const { width, height } = made.canvas;
            made.putImageData(noisePixels(engine, operands, this.context.getTransform().invertSelf(), width, height), 0, 0);
        });
    }

    clip(outside, evenOdd, elements) {
        const path = pathOf(elements);
        this.setMatrix();
        this.context.clip(outside ? this.inverse(path) : path, outside || evenOdd ? 'evenodd' : 'nonzero');
    }

    save() {
        this.context.save();
    }

    restore() {
        this.context.restore();
        this.placed = this.styled = this.composed = null;
    }

    // Returns the context of a new canvas, by default as large as the current one.
    beside({ width, height } = this.context.canvas, willReadFrequently = false) {
        const canvas = typeof OffscreenCanvas === 'undefined' ? document.createElement('canvas') : new OffscreenCanvas(width, height);
        return Object.assign(canvas, { width, height }).getContext('2d', { willReadFrequently });
    }

    layer() {
        this.layers.push(this.context);
        this.context = this.beside();
    }

    layerEnd(alpha) {
        const { canvas } = this.context;
        this.context = this.layers.pop();
        this.compositeOver(this.context, canvas, OVER, alpha);
    }

    unsupported(name) {
        this.missing.add(name);
    }

    background(colour) {
        const { context, base: [scale, x, y], size: [width, height] } = this, { canvas } = context;
        if (x <= 0 && y <= 0 && scale * width >= canvas.width && scale * height >= canvas.height)
            this.behind = null; // it would be hidden, and drawing it takes longer than drawing all discs
        context.setTransform(scale, 0, 0, scale, x, y);
        this.placed = null;
        context.fillStyle = color(colour);
        context.fillRect(0, 0, width, height);
    }

    color(colour) {
        this.setPaint(color(colour), Math.min(Math.max(colour[3], 0), 1), null, colour[3] >= 1);
    }

    solid(colour, alpha) {
        this.setPaint(color(colour, alpha), alpha, null, colour[3] * alpha >= 1);
    }

    // Gradients are created on each use, because they depend on the current transform.
    linear(x1, y1, x2, y2, alpha, stops) {
        this.setPaint(() => addStops(this.context.createLinearGradient(x1, y1, x2, y2), stops, alpha), alpha);
    }

    // Canvas 2D has only circular gradients. For elliptical gradients, the shape is filled in a transformed coordinate system.
    radial(matrix, x, y, inner, alpha, stops) {
        const [xx, yx, xy, yy, x0, y0] = matrix;
        const radius = Math.sqrt(Math.abs(xx * yy - xy * yx)), even = Math.hypot(xx - yy, xy + yx) < 1e-6 * radius;
        const round = even || !(radius > 0) ? null : new DOMMatrix(matrix);
        const circles = round ? [x, y, inner, 0, 0, 1] : [x0 + xx * x + xy * y, y0 + yx * x + yy * y, radius * inner, x0, y0, radius];
        this.setPaint(() => addStops(this.context.createRadialGradient(...circles), stops, alpha), alpha, round);
    }

    // Executes the next command. Returns its kind.
    command() {
        const kind = this.reader.number();
        if (!COMMANDS[kind])
            throw new Error(`unknown command ${kind} in the display list: drawing.mjs is older than the engine`);
        COMMANDS[kind][1](this.reader, this);
        return kind;
    }

    draw() {
        const { canvas } = this.context, { reader } = this;
        this.context.reset?.();
        if (!this.context.reset)
            this.context.clearRect(0, 0, canvas.width, canvas.height);
        this.context.save();
        while (reader.at < reader.n.length)
            this.command();
        this.context.restore();
        if (this.behind) { // drawn last but behind everything, so that the background does not affect compositing
            this.context.save();
            Object.assign(this.context, { globalCompositeOperation: 'destination-over', fillStyle: this.behind });
            this.context.setTransform(1, 0, 0, 1, 0, 0);
            this.context.fillRect(0, 0, canvas.width, canvas.height);
            this.context.restore();
        }
        return [...this.missing];
    }
}

function addStops(gradient, stops, alpha) {
    for (const { offset, colour } of stops)
        gradient.addColorStop(Math.min(Math.max(offset, 0), 1), color(colour, alpha));
    return gradient;
}

// Draws a display list on a CanvasRenderingContext2D, scaled to fit its canvas and centred. `image(name)` returns the image that a script
// names, for drawImage. `engine` computes the pixels of filters and noise. Returns descriptions of unsupported parts.
export function drawPicture(context, numbers, options = {}) {
    return new Painter(context, numbers, options).draw();
}

// Returns true if a display list has filters or noise, for which drawPicture needs the option `engine`.
export const needsEngine = numbers => numbers[2] !== 0;

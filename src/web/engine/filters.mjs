// filters.mjs: drawing through a filter on a Canvas 2D (lib/draw/filters.c): the shape is drawn on a separate image, which is then
// filtered.
import { FloatImage } from './float_image.mjs';

const MAX_SIGMA = 256, MAX_OFFSET = 2000; // maximum blur and offset, in pixels
const KINDS = ['blur', 'shadow', 'offset', 'dilate', 'erode', 'matrix', 'paint', 'blend', 'drawn'];

// Reads the filter at painter.at (petri-draw.h, PETRI_FILTER_…).
export function readFilter(painter) {
    const kind = KINDS[painter.take(1)[0]], filter = { kind };
    switch (kind) {
    case 'shadow':
        [filter.radii, filter.offset, filter.colour] = [painter.take(2), painter.take(2), painter.take(4)];
        [filter.only] = painter.take(1);
        break;
    case 'blur':
    case 'dilate':
    case 'erode': filter.radii = painter.take(2); break;
    case 'offset': filter.offset = painter.take(2); break;
    case 'matrix': filter.matrix = painter.take(20); break;
    case 'paint': filter.paint = painter.readPaint(); return filter;
    case 'blend':
        [filter.composite] = painter.take(1);
        if (filter.composite < 0)
            filter.factors = painter.take(4);
        break;
    default: return filter;
    }
    filter.input = readFilter(painter);
    if (kind === 'blend')
        filter.other = readFilter(painter);
    return filter;
}

// Returns `margin`, the distance in pixels by which a filter extends a shape, and `everywhere`, which is true if the filter also changes
// transparent pixels.
function needsOf(filter, matrix) {
    if (!filter.input)
        return { margin: 0, everywhere: filter.kind === 'paint' };
    const { radii = [0, 0], offset = [0, 0] } = filter, inputs = [filter.input, filter.other].filter(Boolean);
    const needs = inputs.map(input => needsOf(input, matrix)), radius = Math.max(...inPixels(radii, matrix));
    const blurs = filter.kind === 'blur' || filter.kind === 'shadow';
    return {
        margin: Math.min(Math.max(...moved(offset, matrix).map(Math.abs)), MAX_OFFSET)
            + (blurs ? 3 * Math.min(radius, MAX_SIGMA) : Math.min(radius, MAX_OFFSET)) + needs.reduce((sum, need) => sum + need.margin, 0),
        everywhere: filter.matrix?.[19] || filter.factors?.[3] || needs.some(need => need.everywhere),
    };
}

const inPixels = (radii, { a, b, c, d }) => [radii[0] * Math.hypot(a, b), radii[1] * Math.hypot(c, d)];
const moved = ([dx, dy], { a, b, c, d }) => [a * dx + c * dy, b * dx + d * dy];

// Applies a filter and returns a new image. `host` has a matrix, the image `drawn`, and the functions paintAll(paint) and blend(composite,
// below, above), which return images.
function applyFilter(filter, host) {
    if (filter.kind === 'drawn')
        return host.drawn.copy();
    if (filter.kind === 'paint')
        return host.paintAll(filter.paint);
    const sheet = applyFilter(filter.input, host), radii = filter.radii && inPixels(filter.radii, host.matrix);
    switch (filter.kind) {
    case 'blur': return sheet.blur(radii);
    case 'shadow': {
        const shadow = sheet.copy().shade(filter.colour).blur(radii).move(...moved(filter.offset, host.matrix));
        return filter.only ? shadow : shadow.under(sheet);
    }
    case 'offset': return sheet.move(...moved(filter.offset, host.matrix));
    case 'matrix': return sheet.recolour(filter.matrix);
    case 'blend': {
        const other = applyFilter(filter.other, host);
        return filter.factors ? sheet.combine(other, filter.factors) : host.blend(filter.composite, sheet, other);
    }
    default: return sheet.spread(radii, filter.kind === 'erode');
    }
}

// Returns the bounding box of the drawn pixels; null if there are none.
function inkOf(context) {
    const { width, height } = context.canvas, pixels = new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
    let left = width, right = -1, top = -1, bottom = -1;
    for (let y = 0; y < height; y++) {
        const row = pixels.subarray(y * width, (y + 1) * width), first = row.findIndex(pixel => pixel !== 0);
        if (first < 0)
            continue;
        top = top < 0 ? y : top;
        bottom = y;
        left = Math.min(left, first);
        right = Math.max(right, row.findLastIndex(pixel => pixel !== 0));
    }
    return right < 0 ? null : { left, right, top, bottom };
}

// Returns [x, y, width, height] of the area of a canvas that the filtered image covers: the box `ink`, extended by `edge` on each side.
function boxOf({ width, height }, ink, edge) {
    const x = Math.max(ink.left - edge, 0), y = Math.max(ink.top - edge, 0);
    return [x, y, Math.min(ink.right + 1 + edge, width) - x, Math.min(ink.bottom + 1 + edge, height) - y];
}

// Draws with `act` through the painter's filter, and composites the result with `composite`, a mode of Canvas 2D.
export function drawFiltered(painter, act, composite) {
    const { filter, context } = painter;
    painter.setMatrix();
    const matrix = context.getTransform(), { margin, everywhere } = needsOf(filter, matrix), edge = Math.ceil(margin) + 2;
    const { width, height } = context.canvas;
    const apart = painter.apart(width + 2 * edge, height + 2 * edge, -edge, -edge, act), all = apart.canvas;
    const ink = everywhere ? { left: 0, right: all.width, top: 0, bottom: all.height } : inkOf(apart);
    if (!ink || !composite)
        return;
    const box = boxOf(all, ink, edge), [x, y, ...size] = box;
    const sheetOf = made => FloatImage.of(made, 0, 0, ...size), empty = () => painter.beside({ width: size[0], height: size[1] }, true);
    const result = applyFilter(filter, {
        matrix,
        drawn: FloatImage.of(apart, ...box),
        paintAll: paint => sheetOf(painter.apart(...size, x - edge, y - edge, () => painter.paintAll(paint))),
        blend(mode, below, above) {
            const made = empty(), other = above.put(empty());
            below.put(made);
            return sheetOf(painter.combine(made, other, mode));
        },
    });
    painter.compositeOver(context, result.put(empty()), composite, 1, x - edge, y - edge);
}

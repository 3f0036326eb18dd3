// pixels.mjs: pixels of canvases in the engine's memory, and the engine's drawing of noise and filters.

let canvas = null;

// Returns a Canvas 2D of this size for reading pixels; all calls share one canvas.
export function pixelContext(width, height) {
    canvas ??= new OffscreenCanvas(width, height);
    if (canvas.width !== width || canvas.height !== height)
        Object.assign(canvas, { width, height });
    return canvas.getContext('2d', { willReadFrequently: true });
}

// Copies the pixels of an area of a canvas to the engine's memory, in the format of ImageData.
function copyPixels(memory, context, at, [x, y, width, height]) {
    memory.bytes().set(context.getImageData(x, y, width, height).data, at);
}

// Reads the whole canvas into the engine's memory, in the engine's format.
export function readPixels(memory, context, at) {
    const { width, height } = context.canvas;
    copyPixels(memory, context, at, [0, 0, width, height]);
    memory.wasm.web_pixels_from_image_data(at, width * height);
}

const imageData = (memory, at, width, height) =>
    new ImageData(new Uint8ClampedArray(memory.bytes().buffer, at, 4 * width * height).slice(), width, height);

// Calls `use` with the addresses of blocks of memory, in the order of `blocks`. A block is an array of numbers, which are copied, or a
// number of bytes.
function withBlocks({ wasm, numbers }, blocks, use) {
    const places = blocks.map(block => wasm.malloc(block.length ? 8 * block.length : block));
    try {
        if (places.includes(0))
            throw new RangeError('out of memory');
        blocks.forEach((block, i) => block.length && numbers(places[i], block.length).set(block));
        return use(...places);
    } finally {
        places.forEach(at => wasm.free(at));
    }
}

const numbersOf = ({ a, b, c, d, e, f }) => [a, b, c, d, e, f];

// Returns ImageData with pixels of the engine's format that are given as numbers.
export function unpackPixels({ memory }, pixels, width, height) {
    return withBlocks(memory, [4 * pixels.length], at => {
        memory.words(at, pixels.length).set(pixels);
        memory.wasm.web_pixels_to_image_data(at, pixels.length);
        return imageData(memory, at, width, height);
    });
}

// Returns ImageData with noise. `operands` are those of PETRI_DRAW_NOISE; `toUnits` is the DOMMatrix from pixels to units.
export function noisePixels({ memory }, operands, toUnits, width, height) {
    return withBlocks(memory, [operands, numbersOf(toUnits), 4 * width * height], (numbers, matrix, at) => {
        memory.wasm.web_noise(numbers, matrix, at, width, height);
        return imageData(memory, at, width, height);
    });
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

// Draws with `act` through a filter, the operand of PETRI_DRAW_FILTER, and composites the result with `mode`, a mode of Canvas 2D.
export function drawFiltered(painter, filter, act, mode) {
    const { context, engine } = painter, { memory } = engine, { wasm } = memory;
    painter.setMatrix();
    const transform = numbersOf(context.getTransform());
    withBlocks(memory, [filter, transform, 16], (numbers, matrix, out) => {
        wasm.web_filter_measure(numbers, filter.length, matrix, out);
        const [margin, everywhere] = memory.numbers(out, 2), edge = Math.ceil(margin) + 2, { width, height } = context.canvas;
        const apart = painter.apart(width + 2 * edge, height + 2 * edge, -edge, -edge, act), all = apart.canvas;
        const ink = everywhere ? { left: 0, right: all.width, top: 0, bottom: all.height } : inkOf(apart);
        if (!ink || !mode)
            return;
        const box = boxOf(all, ink, edge), [x, y, ...size] = box;
        const result = withBlocks(memory, [4 * size[0] * size[1]], at => {
            copyPixels(memory, apart, at, box);
            engine.paint = (commands, pixels) => {
                const paint = painter.readFilterPaint(commands);
                const made = painter.apart(...size, x - edge, y - edge, () => painter.paintAll(paint));
                copyPixels(memory, made, pixels, [0, 0, ...size]);
            };
            wasm.web_filter(numbers, filter.length, matrix, at, ...size);
            return imageData(memory, at, ...size);
        });
        const made = painter.beside({ width: size[0], height: size[1] }, true);
        made.putImageData(result, 0, 0);
        painter.compositeOver(context, made.canvas, mode, 1, x - edge, y - edge);
    });
}

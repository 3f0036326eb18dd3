// pixels.mjs: canvases and images in the engine's pixel format: alpha in the highest byte, then premultiplied red, green and blue.
let canvas = null;

// Returns a Canvas 2D of this size for reading pixels; all calls share one canvas.
export function pixelContext(width, height) {
    canvas ??= new OffscreenCanvas(width, height);
    if (canvas.width !== width || canvas.height !== height)
        Object.assign(canvas, { width, height });
    return canvas.getContext('2d', { willReadFrequently: true });
}

// Reads the whole canvas into an array of 32-bit numbers.
export function readPixels(context, out) {
    const { width, height } = context.canvas, { data } = context.getImageData(0, 0, width, height);
    const pixels = new Uint32Array(data.buffer);
    for (let i = 0; i < out.length; i++) {
        const p = pixels[i], alpha = p >>> 24;
        if (alpha === 255)
            out[i] = (p & 0xff00ff00) | (p & 255) << 16 | (p >> 16 & 255);
        else // getImageData has divided by alpha; multiplying by alpha restores the premultiplied bytes
            out[i] = alpha && (alpha << 24 | Math.round((p & 255) * alpha / 255) << 16
                | Math.round((p >> 8 & 255) * alpha / 255) << 8 | Math.round((p >> 16 & 255) * alpha / 255));
    }
}

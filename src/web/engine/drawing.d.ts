// drawing.d.ts: the types of drawing.mjs.

/** The size of a picture in the script's units: what a canvas may have. */
export function pictureSize(numbers: Float64Array): { width: number; height: number };

/**
 * Draws a picture (`Session.picture`), scaled to fit the canvas and centred. `image` gives the images that scripts name,
 * `background` a colour (null: none; else black). Returns what is left out, as words.
 */
export function drawPicture(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, numbers: Float64Array,
    options?: { image?: (name: string) => CanvasImageSource | null | undefined; background?: string | null }): string[];

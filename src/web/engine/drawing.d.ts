// drawing.d.ts: types and documentation of drawing.mjs.

/** Returns the size of a picture in the script's units, from which the size of the canvas can be chosen. */
export function pictureSize(numbers: Float64Array): { width: number; height: number };

/** Draws a display list (`Session.displayList`), scaled to fit the canvas and centred. `image` returns images that
 * scripts name; `background` is a colour (default: black; null: none). Returns descriptions of unsupported parts.
 */
export function drawPicture(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, numbers: Float64Array,
    options?: { image?: (name: string) => CanvasImageSource | null | undefined; background?: string | null }): string[];

// drawing.d.ts: types and documentation of drawing.mjs.
import type { Engine } from './petri.js';

/** Returns the size of a picture in the script's units, from which the size of the canvas can be chosen. */
export function pictureSize(numbers: Float64Array): { width: number; height: number };

/** Draws a display list (`Session.displayList`), scaled to fit the canvas and centred. `image` returns images that
 * scripts name; `background` is a colour (default: black; null: none). `engine` computes the pixels of filters and noise; without it,
 * these are unsupported (`needsEngine`). Returns descriptions of unsupported parts.
 */
export function drawPicture(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, numbers: Float64Array,
    options?: { image?: (name: string) => CanvasImageSource | null | undefined; background?: string | null; engine?: Engine | null }):
    string[];

/** Returns true if a display list has filters or noise, for which `drawPicture` needs the option `engine`. */
export function needsEngine(numbers: Float64Array): boolean;

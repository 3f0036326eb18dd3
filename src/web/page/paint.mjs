// paint.mjs: what the worker gives as a picture, on a canvas: of the page, or of a film's frame.
import { drawPicture } from '../engine/drawing.mjs';

export const pictureSize = ({ numbers }) => [numbers[0], numbers[1]];

// Returns what is left out, as words.
export const paint = (context, { numbers }, images) =>
    drawPicture(context, numbers, { image: name => images.get(name.replace(/^.*\//, '')) });

const IMAGE = /\.(png|jpe?g|gif|webp)$/i;

// Images that scripts may name, by the name without its folder.
export async function addImage(images, name, bytes) {
    if (IMAGE.test(name))
        images.set(name.replace(/^.*\//, ''), await createImageBitmap(new Blob([bytes])).catch(() => null));
}

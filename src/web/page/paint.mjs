// paint.mjs: what the worker gives as a picture, on a canvas: of the page, or of a film's frame.
import { drawPicture, pictureSize } from '../engine/drawing.mjs';

export const sizeOf = ({ image, numbers }) => image ?? pictureSize(numbers);

// Draws what WebGL 2 has made, or draws by itself. Returns what is left out, as words.
export function paint(context, { image, numbers, unsupported }, images) {
    if (!image)
        return drawPicture(context, numbers, { image: name => imageOf(images, name) });
    const { width, height } = context.canvas;
    context.clearRect(0, 0, width, height); // nothing of the picture before is seen through it
    context.drawImage(image, 0, 0, width, height);
    image.close();
    return unsupported;
}

const IMAGE = /\.(png|jpe?g|gif|webp)$/i;
const baseName = name => name.replace(/^.*\//, '');

// Images that scripts may name, by the name without its folder.
export const imageOf = (images, name) => images.get(baseName(name));

export async function addImage(images, name, bytes) {
    if (IMAGE.test(name))
        images.set(baseName(name), await createImageBitmap(new Blob([bytes])).catch(() => null));
}

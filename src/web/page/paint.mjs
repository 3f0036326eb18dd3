// paint.mjs: paints a picture from the worker on a canvas of the page or of a video frame.
import { drawPicture, pictureSize } from '../engine/drawing.mjs';

export const sizeOf = ({ image, numbers }) => image ?? pictureSize(numbers);

// Paints an image rendered with WebGL 2, or draws a display list. Returns descriptions of unsupported parts.
export function paint(context, { image, numbers, unsupported }, images) {
    if (!image)
        return drawPicture(context, numbers, { image: name => imageOf(images, name) });
    const { width, height } = context.canvas;
    context.clearRect(0, 0, width, height); // the picture may be transparent
    context.drawImage(image, 0, 0, width, height);
    image.close();
    return unsupported;
}

const IMAGE = /\.(png|jpe?g|gif|webp)$/i;
const baseName = name => name.replace(/^.*\//, '');

// Returns the image that a script names. Folders in the name are ignored.
export const imageOf = (images, name) => images.get(baseName(name));

export async function addImage(images, name, bytes) {
    if (IMAGE.test(name))
        images.set(baseName(name), await createImageBitmap(new Blob([bytes])).catch(() => null));
}

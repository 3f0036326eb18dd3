// render_page.mjs: the page in which `petri render` draws pictures (render.mjs).
import { drawPicture, pictureSize } from './drawing.mjs';
import { loadEngine } from './petri.mjs';

const post = async (name, body) => {
    const { ok, status } = await fetch(name, { method: 'POST', body });
    if (!ok)
        throw new Error(`the server returned status ${status}`);
};
const plain = name => name.replace(/^\.\//, '');

let reported = [];
// Sends messages to the command, which prints them.
const report = async text => {
    const lines = [...reported, ...(text ? [`petri: ${text}\n`] : [])];
    reported = [];
    if (lines.length)
        await post('messages', lines.join(''));
};

// Draws the picture of the last frame. Returns an OffscreenCanvas, or null if there is no picture. Adds the names of unsupported parts to
// `missing`.
function draw(session, automatic, image, missing) {
    const picture = session.render({ automatic });
    if (!picture)
        return null;
    const { width, height } = picture.image ?? pictureSize(picture.numbers);
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    let unsupported;
    if (picture.image) {
        unsupported = picture.unsupported;
        context.drawImage(picture.image, 0, 0);
        picture.image.close();
    } else {
        unsupported = drawPicture(context, picture.numbers, { image });
    }
    unsupported.forEach(name => missing.add(name));
    return context.canvas;
}

// Runs the script as the native `petri render` does. Returns true if all pictures were drawn.
async function render({ text, name, files, imageNames, define, quiet, automatic, fps, frame, frames, every, series }) {
    const images = new Map();
    for (const [index, file] of imageNames.entries())
        images.set(plain(file), await createImageBitmap(await (await fetch(`image/${index}`)).blob()).catch(() => null));
    const image = file => images.get(plain(file)) ?? null;
    const engine = await loadEngine();
    const onDiagnostic = ({ level, rendered }) => (!quiet || level === 'error') && reported.push(rendered);
    const session = engine.open({ files, fps, work: 2 ** 30, image, onDiagnostic });
    const missing = new Set();
    let failed = false, drawn = 0, before = 0;
    const save = async number => {
        const canvas = draw(session, automatic, image, missing);
        if (!canvas)
            return;
        await post(`picture/${number}`, await canvas.convertToBlob());
        drawn++;
    };
    for (const definition of define)
        session.define(definition);
    session.load(text, name);
    for (let number = 0; number < (frame === null ? frames + before : frame + 1); number++) {
        session.step();
        session.renderIfNeeded();
        // The first frames, in which particles have no positions yet, are not counted, as in the native command.
        const early = frame === null && number === before && session.displayList({ automatic })?.ready === false;
        before += early ? 1 : 0;
        if (series && !early && (frame === null ? (number - before) % every === 0 : number === frame))
            await save(number);
        await report();
    }
    if (!series)
        await save(session.frame.number);
    if (missing.size > 0) {
        await report(`this browser cannot draw: ${[...missing].join(', ')}`);
        failed = true;
    }
    if (drawn === 0) {
        await report('no frame was drawn');
        failed = true;
    }
    await report();
    return !failed;
}

let status = 1;
try {
    status = await render(await (await fetch('job.json')).json()) ? 0 : 1;
} catch (error) {
    // The messages of a PetriError have been collected. A rejected definition is an error of the command line.
    await report(error.diagnostics?.length ? '' : error.message).catch(() => {});
    if (error.diagnostics?.some(({ level, code }) => level === 'error' && code === 'bad-definition'))
        status = 2;
}
await post(`ended/${status}`);

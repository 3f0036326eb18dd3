// exports.mjs: exports frames of a script as a video or table, in the worker.
import { Film } from './film.mjs';
import { paint, sizeOf } from './paint.mjs';

const REPORT_INTERVAL = 10; // frames between progress messages

// Goes to each frame from `from` to `to` and calls `see`.
async function each(player, { from, to, shouldInterrupt, onProgress }, see) {
    for (let frame = from; frame <= to; frame++) {
        if (shouldInterrupt())
            throw Object.assign(new Error('stopped'), { status: 'interrupted' });
        player.seek(frame);
        await see();
        if ((frame - from) % REPORT_INTERVAL === 0)
            onProgress(frame - from, to - from + 1);
    }
}

export async function makeFilm(player, images, show, range) {
    let film = null, automatic = false;
    await each(player, range, async () => {
        let picture = show(automatic);
        film ??= await Film.begin(picture ? sizeOf(picture) : { width: 640, height: 480 }, player.session.frame.fps);
        const left = picture ? paint(film.context, picture, images) : [];
        if (left.length && picture.lost)
            throw new Error('cannot make the video: the WebGL context was lost');
        if (left.includes('canvas3d')) {
            automatic = true;
            picture = show(automatic);
            paint(film.context, picture, images);
        }
        await film.add();
    });
    return film.end();
}

// Returns a table of particles as written by `petri run --trajectory run.csv`.
export async function makeTable(player, range) {
    const parts = [];
    let columns = 0;
    await each(player, range, () => {
        const { text, dimensions } = player.session.table(columns);
        columns = dimensions;
        parts.push(text);
    });
    return new Blob(parts, { type: 'text/csv' });
}

const quoted = text => /[,"\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;

export function makeState(player) {
    const rows = Array.from(player.session.state, ([key, value]) =>
        `${quoted(key)},${quoted(Array.isArray(value) ? value.join(';') : value)}\n`);
    return new Blob(['key,value\n', ...rows], { type: 'text/csv' });
}

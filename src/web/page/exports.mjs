// exports.mjs: exports frames of a script as a film or table, in the worker, which loads this file at the first export.
import { beginFilm } from './film.mjs';

const REPORT_INTERVAL = 10; // frames between progress messages

// Goes to each frame from `from` to `to` and calls `see`.
async function each(player, { from, to, shouldInterrupt, onProgress }, see) {
    for (let frame = from; frame <= to; frame++) {
        if (shouldInterrupt())
            throw Object.assign(new Error('stopped'), { status: 'interrupted' });
        player.seek(frame);
        await see(frame);
        if ((frame - from) % REPORT_INTERVAL === 0)
            onProgress(frame - from, to - from + 1);
    }
}

// Returns a file of a kind that film.mjs makes. show: returns the picture of the current frame; paint, sizeOf: functions of paint.mjs.
async function makeFilm(kind, { player, images, show, paint, sizeOf }, range) {
    let film = null, automatic = false;
    try {
        await each(player, range, async frame => {
            if (film && (frame - range.from) % film.every)
                return;
            let picture = show(automatic);
            film ??= await beginFilm(kind, picture ? sizeOf(picture) : { width: 640, height: 480 }, player.session.frame.fps);
            const left = picture ? paint(film.context, picture, images) : [];
            if (left.length && picture.lost)
                throw new Error('cannot make the film: the WebGL context was lost');
            if (left.includes('canvas3d')) {
                automatic = true;
                picture = show(automatic);
                paint(film.context, picture, images);
            }
            await film.add();
        });
        return await film.end();
    } catch (error) {
        film?.cancel();
        throw error;
    }
}

// Returns a table of particles as written by `petri run --trajectory run.csv`.
async function makeTable(player, range) {
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

function makeState(player) {
    const rows = Array.from(player.session.state, ([key, value]) =>
        `${quoted(key)},${quoted(Array.isArray(value) ? value.join(';') : value)}\n`);
    return new Blob(['key,value\n', ...rows], { type: 'text/csv' });
}

// Returns the file of a kind: 'gif', 'mp4', 'webm', 'particles' or 'state'.
export const makeFile = (kind, tools, range) => kind === 'particles' ? makeTable(tools.player, range)
    : kind === 'state' ? makeState(tools.player) : makeFilm(kind, tools, range);

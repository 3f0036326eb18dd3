// webm.mjs: writes WebM files: EBML elements, each with an id, a length and content.

const TICKS = 1e6; // unit of timestamps in nanoseconds: a millisecond
const encoder = new TextEncoder();

const join = parts => {
    const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) {
        all.set(part, at);
        at += part.length;
    }
    return all;
};

// Encodes an integer in as few bytes as possible, but in at least `min` bytes.
function whole(value, min = 1) {
    const bytes = [];
    for (let left = value; left > 0 || bytes.length < min; left = Math.floor(left / 256))
        bytes.unshift(left % 256);
    return Uint8Array.from(bytes);
}

function real(value) {
    const bytes = new Uint8Array(8);
    new DataView(bytes.buffer).setFloat64(0, value);
    return bytes;
}

const content = part => typeof part === 'number' ? whole(part) : typeof part === 'string' ? encoder.encode(part) : part;

// Returns an element. The field for its length always has eight bytes, as its first byte (1) indicates.
function element(id, ...parts) {
    const inside = join(parts.map(content));
    return join([whole(id), Uint8Array.of(1), whole(inside.length, 7), inside]);
}

// Returns the Cues element, a table of the times and positions of the clusters, each of which begins with a key frame. `before` is the
// length of the elements before the first cluster. Positions count from the start of the segment's data.
const cues = (clusters, before) => {
    let at = before;
    return element(0x1C53BB6B, ...clusters.map(({ time, bytes }) => {
        const cue = element(0xBB, element(0xB3, whole(time, 8)), element(0xB7, element(0xF7, 1), element(0xF1, whole(at, 8))));
        at += bytes.length;
        return cue;
    }));
};

// codec: 'V_VP9' or 'V_VP8'; chunks: { data, time in milliseconds, key }, beginning with a key frame.
export function packFilm({ codec, width, height, fps, chunks }) {
    const head = element(0x1A45DFA3, element(0x4286, 1), element(0x42F7, 1), element(0x42F2, 4), element(0x42F3, 8),
        element(0x4282, 'webm'), element(0x4287, 4), element(0x4285, 2));
    const info = element(0x1549A966, element(0x2AD7B1, TICKS), element(0x4489, real(chunks.length * 1000 / fps)),
        element(0x4D80, 'petri'), element(0x5741, 'petri'));
    const tracks = element(0x1654AE6B, element(0xAE, element(0xD7, 1), element(0x73C5, 1), element(0x83, 1), element(0x86, codec),
        element(0x23E383, Math.round(1e9 / fps)), element(0xE0, element(0xB0, width), element(0xBA, height))));
    const groups = [];
    for (const chunk of chunks) {
        if (chunk.key)
            groups.push([]);
        groups.at(-1).push(chunk);
    }
    const clusters = groups.map(group => {
        const [{ time }] = group;
        const blocks = group.map(chunk =>
            element(0xA3, Uint8Array.of(0x81), whole(chunk.time - time, 2), Uint8Array.of(chunk.key ? 0x80 : 0), chunk.data));
        return { time, bytes: element(0x1F43B675, element(0xE7, time), ...blocks) };
    });
    const begin = info.length + tracks.length, places = cues(clusters, begin + cues(clusters, 0).length);
    return new Blob([head, element(0x18538067, info, tracks, places, ...clusters.map(({ bytes }) => bytes))], { type: 'video/webm' });
}

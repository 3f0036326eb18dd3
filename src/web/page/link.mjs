// link.mjs: links that contain a script: `#` and compressed JSON (deflate-raw, base64url). v: version, t: text, n: file name, c: parameter
// changes as [last frame before the change, name, value], f: frame, d: digest of the state after this frame,
// s: version of the specification by which it was computed; links of petri 0.3 have none.
// Links of petri 0.2 have h, the SHA-256 of the printed state, instead of d.

const VERSION = 1;
export const SPEC = '0.4'; // version of the specification (lib/base/spec.h)
const MAX_LENGTH = 100000; // characters; longer links are truncated by some browsers and mail programs
const MAX_TEXT = 4 << 20; // maximum length of the uncompressed text
const MAX_CHANGES = 10000;

async function through(stream, bytes, max = Infinity) {
    const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader(), parts = [];
    let length = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done)
            break;
        length += value.length;
        if (length > max) {
            reader.cancel().catch(() => {});
            throw new Error('the link contains more than 4 MiB of data, so it is not opened');
        }
        parts.push(value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

export async function packLink({ text, name, changes = [], frame, digest }) {
    if (changes.length > MAX_CHANGES)
        throw new Error(`too many parameter changes for a link: ${changes.length}, at most ${MAX_CHANGES}; press Reset to discard them`);
    const json = JSON.stringify({ v: VERSION, t: text, n: name, c: changes, f: frame, d: digest, s: SPEC });
    const packed = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(json));
    let binary = '';
    for (const byte of packed)
        binary += String.fromCharCode(byte);
    const link = '#' + btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
    if (link.length > MAX_LENGTH)
        throw new Error(`the script is too long for a link: ${link.length} characters, at most ${MAX_LENGTH}; save it as a file`);
    return link;
}

// Rejects control characters, because a link with a line break in its file name could forge messages.
const isFileName = name => typeof name === 'string' && !/[\0-\x1f\x7f]/.test(name);

const isChange = change => Array.isArray(change) && change.length === 3 && Number.isInteger(change[0])
    && typeof change[1] === 'string' && typeof change[2] === 'string';

// The inverse of packLink. A link has at most `max` characters. Throws an error with a message for the user if the link is invalid.
export async function readLink(link, max = MAX_LENGTH) {
    const packed = link.replace(/^#/, '').replaceAll('-', '+').replaceAll('_', '/');
    let json;
    if (packed.length > max)
        throw new Error(`the link is too long: ${packed.length} characters, at most ${max}`);
    try {
        const bytes = Uint8Array.from(atob(packed), character => character.charCodeAt(0));
        const text = await through(new DecompressionStream('deflate-raw'), bytes, MAX_TEXT);
        json = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text));
    } catch (error) {
        throw new Error(error.message.startsWith('the link') ? error.message
            : 'the link is damaged; check that it was copied completely', { cause: error });
    }
    if (json?.v > VERSION)
        throw new Error('the link is from a newer petri; reload the page to get the latest version');
    const { t: text, n: name = 'script.fl', c: changes = [], f: frame = 0, d: digest = null, h: hash = null, s: spec = '0.3' } = json ?? {};
    if (Array.isArray(changes) && changes.length > MAX_CHANGES)
        throw new Error('the link contains more than 10000 parameter changes, so it is not opened');
    if (typeof text !== 'string' || !isFileName(name) || !Array.isArray(changes) || !changes.every(isChange)
        || !Number.isInteger(frame) || frame < -1 || frame > 1e6
        || [digest, hash].some(value => value !== null && typeof value !== 'string') || typeof spec !== 'string')
        throw new Error('not a petri link');
    return { text, name, changes, frame, digest, hash, spec };
}

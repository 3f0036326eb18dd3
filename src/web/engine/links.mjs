// links.mjs: compression and JSON for `petri link` and `petri open` in Node.js (src/web/command/links.c).
import { createRequire } from 'node:module';

const TYPES = { number: 1, string: 2 }; // json_type
const ARRAY = 3, OBJECT = 4;

function depthOf(value) {
    return value && typeof value === 'object' ? 1 + Math.max(0, ...Object.values(value).map(depthOf)) : 0;
}

// Returns the imports. `system` is the System of the command.
export function linkFunctions(system) {
    const zlib = () => createRequire(import.meta.url)('node:zlib'); // loaded only when it is needed
    const values = [null], numbers = new Map(), texts = new Map();
    const add = value => {
        if (value === null || value === undefined)
            return 0;
        if (typeof value !== 'object')
            return values.push(value) - 1;
        if (!numbers.has(value))
            numbers.set(value, values.push(value) - 1);
        return numbers.get(value);
    };
    const put = (bytes, to, capacity) => {
        if (bytes.length > capacity)
            return -2;
        system.bytes(to, bytes.length).set(bytes);
        return bytes.length;
    };
    return {
        deflate: (from, length, to, capacity) =>
            put(zlib().deflateRawSync(system.bytes(from, length), { level: 9, memLevel: 9 }), to, capacity),
        inflate: (from, length, to, capacity) => {
            try {
                const { buffer, engine } = zlib().inflateRawSync(system.bytes(from, length), { info: true, maxOutputLength: capacity });
                return engine.bytesWritten === length ? put(buffer, to, capacity) : -1;
            } catch (error) {
                return error.code === 'ERR_BUFFER_TOO_LARGE' ? -2 : -1;
            }
        },
        json_parse: (text, length, depth) => {
            try {
                const value = JSON.parse(Buffer.from(system.bytes(text, length)).toString());
                return depthOf(value) < depth ? add(value) : 0;
            } catch {
                return 0;
            }
        },
        json_free: () => {
            for (const { at } of texts.values())
                system.wasm.free(at);
            values.length = 1;
            numbers.clear();
            texts.clear();
        },
        json_type: number => {
            const value = values[number];
            return Array.isArray(value) ? ARRAY : value && typeof value === 'object' ? OBJECT
                : typeof value === 'number' && !Number.isInteger(value) ? 0 : TYPES[typeof value] ?? 0;
        },
        json_number: number => (typeof values[number] === 'number' ? values[number] : 0),
        json_string: (number, length) => {
            if (typeof values[number] !== 'string')
                return 0;
            if (!texts.has(number)) {
                const bytes = Buffer.from(`${values[number]}\0`), at = system.wasm.malloc(bytes.length);
                system.bytes(at, bytes.length).set(bytes);
                texts.set(number, { at, length: bytes.length - 1 });
            }
            const text = texts.get(number);
            system.view.setInt32(length >>> 0, text.length, true);
            return text.at;
        },
        json_length: number => values[number].length,
        json_item: (number, index) => add(values[number][index]),
        json_member: (number, key) => {
            const name = Buffer.from(system.string(key), 'latin1').toString();
            return Object.hasOwn(values[number], name) ? add(values[number][name]) : 0;
        },
    };
}

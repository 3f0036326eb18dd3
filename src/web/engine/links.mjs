// links.mjs: compression for `petri link` and `petri run LINK` in Node.js (src/web/command/links.c).
import { createRequire } from 'node:module';

// Returns the imports. `system` is the System of the command.
export function linkFunctions(system) {
    const zlib = () => createRequire(import.meta.url)('node:zlib'); // loaded only when it is needed
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
    };
}

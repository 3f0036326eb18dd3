// wasm.mjs: loads engine.wasm in pages, workers and Node.js without emscripten's runtime. The engine needs only a clock from the system,
// and calls JavaScript through the functions of src/web/host.h.
import { ArchiveFiles } from './archive.mjs';
import { runtime } from './runtime.mjs';
import { hasSimd } from './simd.mjs';
import { Screen } from './webgl.mjs';

const encoder = new TextEncoder();
const decoder = new TextDecoder();

const ENOSYS = 52, EBADF = 8;

// The engine next to this file. Bundlers copy files whose URLs are constants, so that engineFile() does not help here.
const nextToThis = () => (hasSimd() ? new URL('./engine.wasm', import.meta.url) : new URL('./engine-scalar.wasm', import.meta.url));

// Compiles the engine from bytes, a WebAssembly.Module, a URL or a Response.
export async function compile(source = nextToThis()) {
    if (source instanceof WebAssembly.Module)
        return source;
    if (typeof source === 'string' || source instanceof URL) {
        const url = new URL(source, import.meta.url);
        if (url.protocol === 'file:') {
            const { readFile } = await import('node:fs/promises');
            source = await readFile(url);
        } else {
            source = await fetch(url);
        }
    }
    if (typeof Response !== 'undefined' && source instanceof Response) {
        if (!source.ok)
            throw new Error(`cannot load the engine: ${source.url} returned status ${source.status}`);
        source = await source.arrayBuffer();
    }
    return WebAssembly.compile(source);
}

// Returns the exports of a new instance and functions to access its memory. `host` implements the imports of host.h.
export function instantiate(module, host) {
    let wasm;
    const bytes = () => new Uint8Array(wasm.memory.buffer);
    const text = (at, length) => {
        if (!at)
            return null;
        const all = bytes();
        return decoder.decode(all.subarray(at, length === undefined ? all.indexOf(0, at) : at + length));
    };
    const find = runtime(() => wasm);
    const system = {
        proc_exit: code => {
            throw new Error(`it exited with status ${code}`);
        },
        clock_time_get: (...args) => {
            const now = BigInt(Math.round(performance.now() * 1e6));
            new DataView(wasm.memory.buffer).setBigUint64(args.at(-1), now, true);
            return 0;
        },
    };
    const memory = {
        bytes,
        text,
        floats: (at, length) => new Float32Array(wasm.memory.buffer, at, length),
        words: (at, length) => new Int32Array(wasm.memory.buffer, at, length),
        word: at => new DataView(wasm.memory.buffer).getUint32(at, true),
        setLong: (at, value) => new DataView(wasm.memory.buffer).setBigInt64(at, value, true),
        setWord: (at, value) => new DataView(wasm.memory.buffer).setUint32(at, value, true),
    };
    const screen = new Screen(memory), files = new ArchiveFiles(memory);
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
        const none = from === 'env' ? () => -ENOSYS : () => EBADF; // there is no other file system
        const given = from === 'petri' ? host[name] : find(name) ?? system[name] ?? files.functions[name] ?? screen.functions[name];
        (imports[from] ??= {})[name] = given ?? none;
    }
    wasm = new WebAssembly.Instance(module, imports).exports;
    wasm._initialize();
    return {
        ...memory,
        wasm,
        screen,
        files,
        // Copies a string to the engine's memory for the duration of a call, and calls `use` with its address and length.
        withText: (string, use) => {
            const encoded = typeof string === 'string' ? encoder.encode(string) : string;
            const at = wasm.malloc(encoded.length + 1);
            if (!at)
                throw new RangeError('out of memory');
            try {
                bytes().set(encoded, at);
                bytes()[at + encoded.length] = 0;
                return use(at, encoded.length);
            } finally {
                wasm.free(at);
            }
        },
        // Returns the address of a permanent copy of the bytes; 0 if out of memory.
        keep: array => {
            const at = wasm.malloc(array.length || 1);
            if (!at)
                return 0;
            bytes().set(array, at);
            return at;
        },
        numbers: (at, length) => new Float64Array(wasm.memory.buffer, at, length),
    };
}

// simd.mjs: chooses the engine that the browser can run.

// Returns true if the browser and its processor have WebAssembly SIMD: it accepts a module that counts the bits of a vector's bytes.
export const hasSimd = () => globalThis.WebAssembly?.validate(new Uint8Array([
    0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]));

// Returns the name of the engine's file. Both engines have the same results; the one without SIMD is slower.
export const engineFile = () => (hasSimd() ? 'engine.wasm' : 'engine-scalar.wasm');

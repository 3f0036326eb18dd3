// feature_check.mjs: checks that the browser supports WebAssembly SIMD.

// Returns true if the browser accepts a module that uses SIMD.
export const hasEngine = () => typeof WebAssembly !== 'undefined' && WebAssembly.validate(new Uint8Array([
    0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]));

export const NO_ENGINE = 'petri needs WebAssembly SIMD, which this browser does not support; use a browser of 2021 or later.';

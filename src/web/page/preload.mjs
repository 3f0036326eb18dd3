// preload.mjs: what takes longest, begun before the page has its editor: the engine, and the worker that it goes to.
import { startWorker } from './engine.mjs';
import { hasEngine } from './feature_check.mjs';

const url = new URL('petri/engine.wasm', location.href).href;
if (hasEngine())
    globalThis.petriStart = {
        worker: startWorker(),
        // A server that does not know the type of the file is no reason not to go on.
        source: WebAssembly.compileStreaming(fetch(url)).catch(() => url),
    };

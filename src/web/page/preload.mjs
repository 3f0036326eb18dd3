// preload.mjs: starts loading the engine and its worker before the page's editor, because they take longest.
import { startWorker } from './engine.mjs';
import { hasEngine } from './feature_check.mjs';

const url = new URL('petri/engine.wasm', location.href).href;
if (hasEngine())
    globalThis.petriStart = {
        worker: startWorker(),
        // Continue even if the server does not know the MIME type of the file.
        source: WebAssembly.compileStreaming(fetch(url)).catch(() => url),
    };

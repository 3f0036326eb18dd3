// preload.mjs: starts loading the engine and its worker before the page's editor, because they take the longest to load.
import { engineFile } from '../engine/simd.mjs';
import { startWorker } from './engine.mjs';
import { applyTheme } from './theme.mjs';

applyTheme();

const url = new URL(`petri/${engineFile()}`, location.href).href;
if (globalThis.WebAssembly)
    globalThis.petriStart = {
        worker: startWorker(),
        // Fall back to the URL if the server sends the wrong MIME type.
        source: WebAssembly.compileStreaming(fetch(url)).catch(() => url),
    };

// engine.mjs: the page's side of the worker: requests, answers, and restarting a worker that does not respond.

/* global WORKER_FILE -- build.mjs defines the address of worker.js. */
const PATIENCE = 3000; // ms that an interrupted request may take to stop; after that, the engine is terminated

// Creates a worker. A worker must have the same origin as the page. If the script at `url` has another origin, creates a worker of the
// page's origin that imports the script.
function makeWorker(url) {
    if (url.origin === location.origin)
        return new Worker(url, { type: 'module' });
    const own = URL.createObjectURL(new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' }));
    setTimeout(() => URL.revokeObjectURL(own), 60000);
    return new Worker(own, { type: 'module' });
}

// Starts a worker: worker.js, or the result of the global function `petriWorker` if the page has set it. Its property `broken` is a promise
// that resolves when the worker fails, possibly before the first request.
export function startWorker() {
    const worker = globalThis.petriWorker?.() ?? makeWorker(new URL(WORKER_FILE, import.meta.url));
    worker.broken = new Promise(resolve => {
        worker.onerror = event => resolve(event.message || 'cannot start the engine: worker.js cannot be loaded; reload the page');
    });
    return worker;
}

export class Remote {
    // source: the argument of `loadEngine`, or a promise for it. worker: a worker that was already started, or undefined.
    constructor(source, worker) {
        this.source = source;
        // The id of the last request to interrupt, in shared memory; null if the page is not cross-origin isolated and cannot share memory.
        this.flag = globalThis.crossOriginIsolated ? new Int32Array(new SharedArrayBuffer(4)) : null;
        this.number = 0;
        this.start(worker);
    }

    start(worker = startWorker()) {
        this.worker = worker;
        this.waiting = new Map();
        worker.onmessage = ({ data }) => {
            if (data.type === 'progress')
                return this.progress?.(data);
            if (data.type === 'context')
                return this.onContextChange?.(data.lost);
            const { resolve, reject } = this.waiting.get(data.id);
            this.waiting.delete(data.id);
            if (data.type === 'failed' || data.type === 'broken' || data.type === 'stopped')
                reject(Object.assign(new Error(data.message), data));
            else
                resolve(data);
        };
        // If the worker has never started, starting another one would fail as well.
        let begun = false;
        worker.broken.then(message => {
            worker.dead = message;
            this.fail(message, begun ? 'broken' : 'failed');
        });
        this.ready = Promise.resolve(this.source).then(source => this.ask('open', { source, flag: this.flag }));
        this.ready.then(() => (begun = true), () => {}); // users of `ready` handle errors
        return this.ready;
    }

    fail(message, type) {
        const waiting = [...this.waiting.values()];
        this.waiting.clear();
        waiting.forEach(({ reject }) => reject(Object.assign(new Error(message), { type, reported: [], diagnostics: [] })));
    }

    get busy() {
        return this.waiting.size > 0;
    }

    // Sends a request, with objects to transfer, and returns a promise for the answer. Requests wait until the engine is loaded.
    ask(act, message = {}, transfer = []) {
        const id = ++this.number, { worker } = this;
        if (worker.dead)
            return Promise.reject(new Error(worker.dead));
        return new Promise((resolve, reject) => {
            this.waiting.set(id, { resolve, reject });
            const post = () => worker.postMessage({ ...message, act, id }, transfer);
            if (act === 'open')
                post();
            else
                this.ready.then(post, error => this.waiting.delete(id) && reject(error));
        });
    }

    // Interrupts all pending requests. Returns true if they have ended, and false if the engine must be terminated.
    async stop() {
        if (!this.flag)
            return !this.busy;
        const last = this.number, goesOn = () => [...this.waiting.keys()].some(id => id <= last);
        Atomics.store(this.flag, 0, last);
        const end = performance.now() + PATIENCE;
        while (goesOn() && performance.now() < end)
            await new Promise(resolve => setTimeout(resolve, 5));
        return !goesOn();
    }

    // Terminates the engine.
    end() {
        this.worker.terminate();
        this.fail('stopped', 'ended');
    }

    restart() {
        this.end();
        return this.start();
    }
}

// engine.mjs: the worker as the page sees it: questions and answers, and what to do when it does not come back.

const PATIENCE = 3000; // ms: frames that hear nothing for so long are ended with the engine

// Workers must come from where the page comes from; a page elsewhere has one that imports the other.
function makeWorker(url) {
    if (url.origin === location.origin)
        return new Worker(url, { type: 'module' });
    const own = URL.createObjectURL(new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' }));
    setTimeout(() => URL.revokeObjectURL(own), 60000);
    return new Worker(own, { type: 'module' });
}

// `broken` comes when it has failed, which may be before anyone asks it something.
export function startWorker() {
    const worker = makeWorker(new URL('./worker.js', import.meta.url));
    worker.broken = new Promise(resolve => {
        worker.onerror = event => resolve(event.message || 'the engine cannot be started');
    });
    return worker;
}

export class Remote {
    // source: what `loadEngine` takes, or a promise of it; worker: one that has been started already.
    constructor(source, worker) {
        this.source = source;
        // Which question is to be given up: threads share memory on pages that are isolated from others only.
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
            const { resolve, reject } = this.waiting.get(data.id);
            this.waiting.delete(data.id);
            if (data.type === 'failed' || data.type === 'broken' || data.type === 'stopped')
                reject(Object.assign(new Error(data.message), data));
            else
                resolve(data);
        };
        // One that never came would not come the next time, either.
        let begun = false;
        worker.broken.then(message => {
            worker.dead = message;
            this.fail(message, begun ? 'broken' : 'failed');
        });
        this.ready = Promise.resolve(this.source).then(source => this.ask('open', { source, flag: this.flag }));
        this.ready.then(() => (begun = true), () => {}); // who waits for it hears of it
        return this.ready;
    }

    fail(message, type) {
        const waiting = [...this.waiting.values()];
        this.waiting.clear();
        waiting.forEach(({ reject }) => reject(Object.assign(new Error(message), { type, told: [], diagnostics: [] })));
    }

    get busy() {
        return this.waiting.size > 0;
    }

    // What is asked while the engine is on its way waits for it.
    ask(act, message = {}) {
        const id = ++this.number, { worker } = this;
        if (worker.dead)
            return Promise.reject(new Error(worker.dead));
        return new Promise((resolve, reject) => {
            this.waiting.set(id, { resolve, reject });
            const post = () => worker.postMessage({ ...message, act, id });
            if (act === 'open')
                post();
            else
                this.ready.then(post, error => this.waiting.delete(id) && reject(error));
        });
    }

    // Ends what the engine is at, and all that waits. True if it is as it was before; else it must be ended.
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

    // Ends the engine for good.
    end() {
        this.worker.terminate();
        this.fail('stopped', 'ended');
    }

    restart() {
        this.end();
        return this.start();
    }
}

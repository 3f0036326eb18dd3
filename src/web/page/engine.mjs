// engine.mjs: the worker as the page sees it: questions and answers, and what to do when it does not come back.

export class Remote {
    constructor(source) {
        this.source = source;
        this.start();
    }

    start() {
        this.worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
        this.waiting = new Map();
        this.number = 0;
        this.worker.onmessage = ({ data }) => {
            const { resolve, reject } = this.waiting.get(data.id);
            this.waiting.delete(data.id);
            if (data.type === 'failed' || data.type === 'broken')
                reject(Object.assign(new Error(data.message), data));
            else
                resolve(data);
        };
        this.worker.onerror = event => this.fail(event.message || 'the engine cannot be started');
        this.ready = this.ask('open', { source: this.source });
        return this.ready;
    }

    fail(message) {
        const waiting = [...this.waiting.values()];
        this.waiting.clear();
        waiting.forEach(({ reject }) => reject(Object.assign(new Error(message), { type: 'stopped', told: [], diagnostics: [] })));
    }

    get busy() {
        return this.waiting.size > 0;
    }

    ask(act, message = {}) {
        const id = ++this.number;
        return new Promise((resolve, reject) => {
            this.waiting.set(id, { resolve, reject });
            this.worker.postMessage({ ...message, act, id });
        });
    }

    // Ends whatever the engine is at, for good, and starts another one.
    restart() {
        this.worker.terminate();
        this.fail('stopped');
        return this.start();
    }
}

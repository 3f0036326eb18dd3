// threads.mjs: threads in which `petri test` and `petri sweep` run other instances of the program.
import { Worker } from 'node:worker_threads';

const ABORTED = 6; // status of an instance that has ended abnormally, as of waitpid

export class Threads {
    // `settings` are those of Worker. `send` receives the messages of the instances, with the ids of their jobs.
    constructor(module, settings, send) {
        Object.assign(this, { module, settings, send, idle: [] });
    }

    // Runs a job in an idle or new thread.
    start({ id, ...job }) {
        const thread = this.idle.pop() ?? this.create();
        thread.id = id;
        thread.postMessage(job);
    }

    create() {
        const thread = new Worker(new URL('./command.mjs', import.meta.url), this.settings);
        thread.postMessage(this.module);
        thread.on('message', message => {
            this.send({ id: thread.id, ...message });
            if ('status' in message)
                this.idle.push(thread);
        });
        thread.on('error', () => this.send({ id: thread.id, status: ABORTED }));
        return thread;
    }
}

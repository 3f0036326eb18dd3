#!/usr/bin/env node
// cli.mjs: the command `petri` in Node.js. It runs in a thread, because the main thread's stack is too small, and receives signals.
import fs from 'node:fs';
import { constants } from 'node:os';
import { isatty } from 'node:tty';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import { posixPaths, windowsPaths } from './paths.mjs';

// petri-command.wasm has a stack of 64 MiB for data; that of Node.js grows at most twice as fast.
const STACK_MEBIBYTES = 192;

const windows = process.platform === 'win32';
const paths = windows ? windowsPaths : posixPaths;
// The page that `petri link --html` fills (src/link/html.c).
const standalone = paths.fromSystem(fileURLToPath(new URL('./page/standalone.html', import.meta.url)));
const toBytes = text => Buffer.from(text).toString('latin1');

// Runs petri-command.wasm.
function runCommand(words) {
    const shared = new Int32Array(new SharedArrayBuffer(8)); // the number of a signal, and a counter of events
    const petri = {
        args: ['petri', ...words.map(argument => paths.fromArgument(argument, fs.existsSync))],
        environment: Object.entries({ PETRI_STANDALONE: standalone, ...process.env })
            .map(([name, value]) => toBytes(`${name}=${value}`)),
        folder: paths.fromSystem(process.cwd()),
        hasInput: words[0] === 'lsp', // the language server must know whether a message is waiting
        terminal: [1, 2].some(isatty) ? (isatty(1) ? process.stdout : process.stderr).getWindowSize() : [0, 0],
    };
    const resourceLimits = { stackSizeMb: STACK_MEBIBYTES };
    const worker = new Worker(new URL('./command.mjs', import.meta.url), { resourceLimits, workerData: { petri: { ...petri, shared } } });
    // Compiled while the thread starts.
    const module = new WebAssembly.Module(fs.readFileSync(new URL('./petri-command.wasm', import.meta.url)));
    worker.postMessage(module);
    const wake = () => {
        Atomics.add(shared, 1, 1);
        Atomics.notify(shared, 1);
    };
    const send = message => {
        worker.postMessage(message);
        wake();
    };
    if (petri.hasInput)
        process.stdin.on('data', input => send({ input })).on('end', () => send({ input: new Uint8Array(0) }));
    let threads = null;
    worker.on('message', job => {
        threads ??= import('./threads.mjs').then(({ Threads }) => new Threads(module, { resourceLimits, workerData: { petri } }, send));
        threads.then(started => started.start(job));
    });
    for (const name of ['SIGINT', 'SIGTERM', 'SIGHUP'])
        process.on(name, () => {
            // The second signal ends a command that does not react.
            if (Atomics.exchange(shared, 0, constants.signals[name]) !== 0)
                process.exit(128 + constants.signals[name]);
            wake();
        });
    worker.on('error', error => {
        console.error(`petri: the program failed: ${error.message}`);
        process.exitCode = 1;
    });
    worker.on('exit', status => {
        process.exitCode ||= status;
        process.exit();
    });
}

const words = process.argv.slice(2);
if (words[0] === 'view' && !words.some(word => /^(-h|--help|--send(=.*)?)$/.test(word))) {
    for (const name of ['SIGINT', 'SIGTERM', 'SIGHUP'])
        process.on(name, () => process.exit(128 + constants.signals[name]));
    const { view } = await import('./view.mjs');
    const status = await view(words.slice(1));
    if (status !== null)
        process.exit(status);
} else {
    // Without a browser or with options that this package does not support, the program reports that it cannot draw.
    const status = words[0] === 'render' ? await (await import('./render.mjs')).render(words.slice(1)) : null;
    if (status === null)
        runCommand(words);
    else
        process.exitCode = status;
}

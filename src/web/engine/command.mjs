// command.mjs: runs petri-command.wasm, the `petri` command, in a thread of Node.js (cli.mjs).
import fs from 'node:fs';
import { isMainThread, parentPort, receiveMessageOnPort, workerData } from 'node:worker_threads';
import { linkFunctions } from './links.mjs';
import { runtime } from './runtime.mjs';
import { Execution, Exit, System } from './system.mjs';

const ENOSYS = 52;

const programs = new Map(); // compiled programs that petri-command.wasm executes, by name

function compile(name) {
    if (!programs.has(name))
        programs.set(name, new WebAssembly.Module(fs.readFileSync(new URL(`./${name}.wasm`, import.meta.url))));
    return programs.get(name);
}

// Runs the command until it ends. `options` are those of System. Returns { status, signal }.
export function runCommand(module, options) {
    const system = new System(options);
    const find = runtime(() => system.wasm);
    const functions = {
        ...system.functions(),
        ...linkFunctions(system),
        gl_ready: () => 0, // there is no OpenGL
        gl_has: () => 0,
    };
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module))
        (imports[from] ??= {})[name] = find(name) ?? functions[name] ?? (() => -ENOSYS);
    system.wasm = new WebAssembly.Instance(module, imports).exports;
    try {
        system.wasm._start();
        return { status: 0 };
    } catch (error) {
        if (error instanceof Exit)
            return error;
        if (error instanceof Execution)
            return runCommand(compile(error.program), { ...options, args: error.args });
        fs.writeSync(options.files?.[2] ?? 2, `petri: the program failed: ${error.message}\n`);
        if (options.environment.some(entry => entry.startsWith('PETRI_TRACE=')))
            fs.writeSync(2, `${error.stack}\n`);
        return { status: 134, signal: 6 };
    } finally {
        system.closeAll();
    }
}

// Runs another instance for `petri test` or `petri sweep`, without standard input. Without `output`, its output is discarded. Returns its
// status as waitpid does. If it starts instances, too, such as a session that records one, they run in its thread.
function runJob(module, options, { output, errors, ...job }) {
    const nothing = fs.openSync(options.windows ? '\\\\.\\nul' : '/dev/null', 'r+'), ended = [];
    const start = ({ id, ...inner }) => ended.push({ id, status: runJob(module, options, inner) });
    const files = [nothing, output ?? nothing, errors ?? nothing];
    const { status, signal } = runCommand(module, { ...options, ...job, files, start, receive: () => ended.shift() ?? null });
    fs.closeSync(nothing);
    return signal ?? status << 8;
}

// Indices in the memory that the command shares with the main thread: the number of a signal, and a counter of events.
const SIGNALS = 0, EVENTS = 1;

if (!isMainThread && workerData?.petri) {
    const { args, environment, folder, hasInput, shared, terminal } = workerData.petri;
    const options = { args, environment, folder, hasInput, terminal, windows: process.platform === 'win32' };
    parentPort.once('message', module => {
        if (shared) {
            const pending = () => Atomics.exchange(shared, SIGNALS, 0);
            const start = job => parentPort.postMessage(job);
            let before = -1; // the counter of events when there was no message
            const receive = wait => {
                const seen = Atomics.load(shared, EVENTS);
                const message = seen === before && !wait ? null : receiveMessageOnPort(parentPort)?.message;
                if (message)
                    return message;
                before = seen;
                if (wait)
                    Atomics.wait(shared, EVENTS, seen);
                return null;
            };
            process.exit(runCommand(module, { ...options, pending, start, receive }).status);
        }
        const send = message => parentPort.postMessage(message);
        parentPort.on('message', job => send({ status: runJob(module, { ...options, send }, job) }));
    });
}

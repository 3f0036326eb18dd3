// command.mjs: runs petri-command.wasm, the `petri` command, in a thread of Node.js (cli.mjs).
import fs from 'node:fs';
import { isMainThread, parentPort, workerData } from 'node:worker_threads';
import { linkFunctions } from './links.mjs';
import { runtime } from './runtime.mjs';
import { Exit, System } from './system.mjs';

const ENOSYS = 52;

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
        fs.writeSync(options.files?.[2] ?? 2, `petri: the program failed: ${error.message}\n`);
        if (options.environment.some(entry => entry.startsWith('PETRI_TRACE=')))
            fs.writeSync(2, `${error.stack}\n`);
        return { status: 134, signal: 6 };
    } finally {
        system.closeAll();
    }
}

// Runs another command, as petri test does, without standard input. Returns its status as waitpid does.
function start(module, options, folder, args, output, errors) {
    const input = fs.openSync(options.windows ? '\\\\.\\nul' : '/dev/null');
    const { status, signal } = runCommand(module, { ...options, args, folder, files: [input, output, errors] });
    fs.closeSync(input);
    return signal ?? status << 8;
}

if (!isMainThread && workerData?.petri) {
    const { args, environment, folder, signals, terminal } = workerData.petri;
    parentPort.once('message', module => {
        const options = {
            args, environment, folder, terminal,
            windows: process.platform === 'win32',
            pending: () => Atomics.exchange(signals, 0, 0),
            start: (...values) => start(module, options, ...values),
        };
        process.exit(runCommand(module, options).status);
    });
}

// archive.mjs: archives of runs, which engine-archives.wasm reads from the memory of JavaScript.
import { callEngine } from './call.mjs';

const EBADF = 8, EINVAL = 28, ENOENT = 44; // errors of emscripten's C library
const REGULAR = 0o100444;

// The only files that an engine can open: archives. They can only be read. The path of a file is its descriptor after a slash.
export class ArchiveFiles {
    // memory: access to the memory of the engine (wasm.mjs).
    constructor(memory) {
        this.last = 2;
        this.files = new Map();
        const number = path => Number(memory.text(path).slice(1)), find = path => this.files.get(number(path));
        const stat = (bytes, error, to) => {
            if (!bytes)
                return -error;
            memory.bytes().fill(0, to, to + 88);
            memory.setWord(to + 12, REGULAR);
            memory.setLong(to + 40, BigInt(bytes.length));
            return 0;
        };
        this.functions = {
            __syscall_openat: (folder, path) => (find(path) ? number(path) : -ENOENT),
            __syscall_stat64: (path, to) => stat(find(path), ENOENT, to),
            __syscall_lstat64: (path, to) => stat(find(path), ENOENT, to),
            __syscall_fstat64: (descriptor, to) => stat(this.files.get(descriptor), EBADF, to),
            __syscall_readlink: path => (find(path) ? -EINVAL : -ENOENT), // there are no links
            fd_pread: (descriptor, list, count, position, moved) => {
                const at = memory.word(list), start = Number(position);
                const part = this.files.get(descriptor)?.subarray(start, start + memory.word(list + 4));
                memory.bytes().set(part ?? [], at);
                memory.setWord(moved, part?.length ?? 0);
                return part ? 0 : EBADF;
            },
            fd_close: () => 0,
        };
    }

    // Adds a file and returns its path.
    add(bytes) {
        this.files.set(++this.last, bytes);
        return `/${this.last}`;
    }

    remove(path) {
        this.files.delete(Number(path.slice(1)));
    }
}

// An archive that is replayed. petri.d.ts documents it.
export class Archive {
    constructor(engine, bytes, memory) {
        this.engine = engine;
        this.path = engine.memory.files.add(bytes);
        this.handle = this.run(wasm => engine.memory.withText(this.path, path => wasm.web_archive_open(path, memory)));
        const problem = this.handle ? this.problem : 'out of memory';
        if (problem || !this.run(wasm => wasm.web_archive_info(this.handle))) {
            const reason = problem ?? this.problem;
            this.close();
            throw new Error(`cannot read the archive: ${reason}`);
        }
        this.info = this.results[0];
    }

    run(act) {
        return callEngine(this, act);
    }

    close() {
        if (this.handle)
            this.run(wasm => wasm.web_archive_close(this.handle));
        this.handle = 0;
        this.engine.memory.files.remove(this.path);
    }

    get problem() {
        return this.engine.memory.text(this.run(wasm => wasm.petri_archive_problem(this.handle)));
    }

    get files() {
        this.run(wasm => wasm.web_archive_files(this.handle));
        return this.results;
    }

    check() {
        this.run(wasm => wasm.petri_archive_check(this.handle));
        return this.problem;
    }

    load(session, frame = -1) {
        session.check('load the archive', wasm => wasm.web_archive_load(this.handle, session.handle, frame));
    }

    endReplay() {
        this.run(wasm => wasm.petri_archive_end_replay(this.handle));
    }

    compare(session) {
        const result = session.run(wasm => wasm.web_archive_compare(this.handle, session.handle));
        return result === 0 ? null : result === 1;
    }
}

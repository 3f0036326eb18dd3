// system.mjs: the system calls of petri-command.wasm in Node.js: files, clock, arguments, signals.
//
// Paths are strings with one byte per character (paths.mjs). Descriptors are the command's own; each refers to an open file of Node.js.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import { isatty } from 'node:tty';
import { joinPath, posixPaths, windowsPaths } from './paths.mjs';

// Numbers of errors in WASI, which emscripten's C library uses.
const ERRORS = {};
for (const [number, name] of ['', '2BIG', 'ACCES', 'ADDRINUSE', 'ADDRNOTAVAIL', 'AFNOSUPPORT', 'AGAIN', 'ALREADY', 'BADF', 'BADMSG', 'BUSY',
    'CANCELED', 'CHILD', 'CONNABORTED', 'CONNREFUSED', 'CONNRESET', 'DEADLK', 'DESTADDRREQ', 'DOM', 'DQUOT', 'EXIST', 'FAULT', 'FBIG',
    'HOSTUNREACH', 'IDRM', 'ILSEQ', 'INPROGRESS', 'INTR', 'INVAL', 'IO', 'ISCONN', 'ISDIR', 'LOOP', 'MFILE', 'MLINK', 'MSGSIZE', 'MULTIHOP',
    'NAMETOOLONG', 'NETDOWN', 'NETRESET', 'NETUNREACH', 'NFILE', 'NOBUFS', 'NODEV', 'NOENT', 'NOEXEC', 'NOLCK', 'NOLINK', 'NOMEM', 'NOMSG',
    'NOPROTOOPT', 'NOSPC', 'NOSYS', 'NOTCONN', 'NOTDIR', 'NOTEMPTY', 'NOTRECOVERABLE', 'NOTSOCK', 'NOTSUP', 'NOTTY', 'NXIO', 'OVERFLOW',
    'OWNERDEAD', 'PERM', 'PIPE', 'PROTO', 'PROTONOSUPPORT', 'PROTOTYPE', 'RANGE', 'ROFS', 'SPIPE', 'SRCH', 'STALE', 'TIMEDOUT', 'TXTBSY',
    'XDEV'].entries())
    ERRORS[`E${name}`] = number;

// Flags of open in emscripten's C library, and what node:fs calls them.
const CREATE = 0x40, FOLDER = 0x10000, NO_LINK = 0x20000, PATH_ONLY = 0x200000;
const FLAGS = { 1: 'O_WRONLY', 2: 'O_RDWR', 0x40: 'O_CREAT', 0x80: 'O_EXCL', 0x200: 'O_TRUNC', 0x400: 'O_APPEND', 0x800: 'O_NONBLOCK',
    [FOLDER]: 'O_DIRECTORY', [NO_LINK]: 'O_NOFOLLOW' };
const APPEND = 0x400;
const AT_FDCWD = -100, AT_SYMLINK_NOFOLLOW = 0x100, AT_REMOVEDIR = 0x200;
const CHARACTER_DEVICE = 2, DIRECTORY = 3, REGULAR = 4;

class SystemError extends Error {
    constructor(code) {
        super(code);
        this.code = code;
    }
}

// Thrown to end the command. `signal`: the signal that ended it, or undefined.
export class Exit extends Error {
    constructor(status, signal) {
        super(`exit ${status}`);
        this.status = status;
        this.signal = signal;
    }
}

// Thrown when the command executes another program of the package (helper_exec.c).
export class Execution extends Error {
    constructor(program, args) {
        super(`execute ${program}`);
        this.program = program;
        this.args = args;
    }
}

const sleeper = new Int32Array(new SharedArrayBuffer(4));
const sleep = milliseconds => Atomics.wait(sleeper, 0, 0, milliseconds);

// An open file, which several descriptors can share.
class OpenFile {
    constructor(real, { path, flags = 0, given = false, folder = false, random = false, seekable = false } = {}) {
        this.real = real; // descriptor of Node.js; -1: a folder or /dev/urandom in Windows
        this.path = path;
        this.flags = flags;
        this.given = given; // the caller closes it
        this.folder = folder;
        this.random = random; // /dev/urandom in Windows
        this.position = seekable ? 0 : null; // null: the system's position, as of pipes
        this.entries = null; // of a folder that is being read
        this.users = 1;
    }
}

export class System {
    // `options`: args, environment, folder (the working directory), files (descriptors 0, 1 and 2 of Node.js), start (runs another
    // instance in another thread), receive (returns the next message of an instance or of the launcher; null: none, possibly after a wait
    // if its argument is true), runs and send (in a helper: the shared runs, and a function that sends a result), pending (returns the
    // number of a signal to deliver, or 0), hasInput (whether the launcher sends standard input in messages), terminal (columns and rows),
    // windows, and procfs (whether /proc/self/fd names open files).
    constructor({ args, environment, folder, files = [0, 1, 2], start, receive, runs = null, send, pending = () => 0, hasInput = false,
        terminal = [0, 0],
        windows = process.platform === 'win32', procfs = process.platform === 'linux' && fs.existsSync('/proc/self/fd') }) {
        this.args = args;
        this.environment = environment;
        this.paths = windows ? windowsPaths : posixPaths;
        this.windows = windows;
        this.procfs = procfs;
        this.folder = folder;
        this.files = new Map(files.map((real, number) => [number, new OpenFile(real, { flags: number ? 1 : 0, given: true })]));
        this.start = start;
        this.pending = pending;
        this.terminal = terminal;
        this.receive = receive;
        this.input = hasInput ? [] : null; // blocks of standard input that were received; an empty block is its end
        this.runs = runs;
        this.send = send;
        this.running = new Set(); // process ids of other instances
        this.ended = []; // instances that have ended and were not waited for: { pid, status }
        this.results = []; // bytes from helpers
        this.lastPid = 1;
    }

    // --- memory

    get view() {
        const buffer = this.wasm.memory.buffer;
        if (this.cachedView?.buffer !== buffer)
            this.cachedView = new DataView(buffer);
        return this.cachedView;
    }

    bytes(at, length) {
        return new Uint8Array(this.wasm.memory.buffer, at >>> 0, length >>> 0);
    }

    string(at) {
        const all = Buffer.from(this.wasm.memory.buffer, at >>> 0);
        return all.latin1Slice(0, all.indexOf(0));
    }

    strings(at) {
        const list = [];
        for (let word; (word = this.view.getUint32(at >>> 0, true)); at += 4)
            list.push(this.string(word));
        return list;
    }

    // --- paths and descriptors

    find(descriptor) {
        const file = this.files.get(descriptor);
        if (!file)
            throw new SystemError('EBADF');
        return file;
    }

    add(file, min = 0) {
        let number = min;
        while (this.files.has(number))
            number++;
        this.files.set(number, file);
        return number;
    }

    realPath(system) {
        return this.paths.fromSystem(fs.realpathSync.native(system, { encoding: this.windows ? 'utf8' : 'buffer' }));
    }

    // Returns true if a folder that was opened is still at its path, and no component of the path became a link.
    isInPlace(folder) {
        const system = this.paths.toSystem(folder.path);
        const info = fs.lstatSync(system, { bigint: true });
        return info.dev === folder.device && info.ino === folder.inode
            && this.realPath(system) === folder.path;
    }

    // Calls `use` with the system's path of `path` in an open folder. The path never leads out of the folder as it was opened: in Linux, it
    // begins with the folder's descriptor; elsewhere, the folder must be in place before and after the call.
    below(descriptor, path, use) {
        if (path === '')
            throw new SystemError('ENOENT');
        if (descriptor === AT_FDCWD || path.startsWith('/'))
            return use(this.paths.toSystem(joinPath(this.folder, path)));
        const folder = this.find(descriptor);
        if (!folder.folder)
            throw new SystemError('ENOTDIR');
        if (this.procfs)
            return use(this.paths.toSystem(`/proc/self/fd/${folder.real}/${path}`));
        if (!this.isInPlace(folder))
            throw new SystemError('ELOOP');
        const result = use(this.paths.toSystem(joinPath(folder.path, path)));
        if (!this.isInPlace(folder)) {
            if (typeof result === 'number')
                fs.closeSync(result);
            throw new SystemError('ELOOP');
        }
        return result;
    }

    // Opens a file by its path for the system. `wanted`: flags of the C library.
    openPath(system, wanted, mode) {
        let flags = 0;
        for (const [bit, name] of Object.entries(FLAGS))
            if (wanted & bit)
                flags |= fs.constants[name] ?? 0;
        if (wanted & PATH_ONLY && process.platform === 'linux')
            flags |= PATH_ONLY;
        // In Windows, there is no flag against links, and folders cannot be opened.
        const info = this.windows ? fs.lstatSync(system, { throwIfNoEntry: false }) : undefined;
        if (info?.isSymbolicLink() && wanted & NO_LINK)
            throw new SystemError('ELOOP');
        if (info && !info.isDirectory() && wanted & FOLDER && !info.isSymbolicLink())
            throw new SystemError('ENOTDIR');
        if (info && wanted & FOLDER)
            return -1;
        return fs.openSync(system, flags, mode);
    }

    open(descriptor, path, wanted, mode) {
        let system;
        if (this.windows && path === '/dev/urandom')
            return this.add(new OpenFile(-1, { random: true }));
        const real = this.below(descriptor, path, use => {
            system = use;
            return this.openPath(use, wanted, mode);
        });
        const info = real >= 0 ? fs.fstatSync(real, { bigint: true }) : fs.statSync(system, { bigint: true });
        const folder = info.isDirectory(), append = wanted & APPEND;
        const file = new OpenFile(real, { flags: wanted, folder, seekable: info.isFile() && !append });
        if (folder) {
            file.path = this.realPath(system);
            file.device = info.dev;
            file.inode = info.ino;
        }
        return this.add(file);
    }

    close(descriptor) {
        const file = this.find(descriptor);
        this.files.delete(descriptor);
        if (--file.users === 0 && file.real > 2 && !file.given)
            fs.closeSync(file.real);
    }

    // Closes what the command has left open.
    closeAll() {
        for (const descriptor of [...this.files.keys()].filter(number => number > 2))
            this.close(descriptor);
    }

    duplicate(descriptor, min) {
        const file = this.find(descriptor);
        file.users++;
        return this.add(file, min);
    }

    setStat(at, info) {
        const view = this.view, time = nanoseconds => [Number(nanoseconds / 1000000000n), Number(nanoseconds % 1000000000n)];
        at >>>= 0;
        this.bytes(at, 88).fill(0);
        view.setUint32(at, Number(BigInt.asUintN(32, info.dev)), true);
        view.setUint32(at + 8, Number(BigInt.asUintN(32, info.ino)), true);
        view.setUint32(at + 12, Number(info.mode), true);
        view.setUint32(at + 16, Number(info.nlink), true);
        view.setUint32(at + 20, Number(info.uid), true);
        view.setUint32(at + 24, Number(info.gid), true);
        view.setBigInt64(at + 40, info.size, true);
        view.setUint32(at + 48, 4096, true);
        view.setUint32(at + 52, Number(BigInt.asUintN(32, info.blocks ?? 0n)), true);
        for (const [offset, value] of [[56, info.atimeNs], [64, info.mtimeNs], [72, info.ctimeNs]]) {
            const [seconds, rest] = time(value);
            view.setInt32(at + offset, seconds, true);
            view.setInt32(at + offset + 4, rest, true);
        }
        view.setBigUint64(at + 80, BigInt.asUintN(64, info.ino), true);
        return 0;
    }

    // --- reading and writing

    // Calls `move` with each block of a list of buffers until one is not filled. Returns the number of bytes.
    transfer(list, count, move) {
        let total = 0;
        for (let i = 0; i < count; i++) {
            const at = (list >>> 0) + 8 * i, length = this.view.getUint32(at + 4, true);
            const moved = length ? move(this.bytes(this.view.getUint32(at, true), length)) : 0;
            total += moved;
            if (moved < length)
                break;
        }
        return total;
    }

    // Calls a function of node:fs again while a pipe or terminal is not ready.
    patiently(call) {
        for (;;) {
            try {
                return call();
            } catch (error) {
                if (error.code === 'EOF') // a closed pipe in Windows
                    return 0;
                if (error.code !== 'EAGAIN')
                    throw error;
                this.deliver();
                sleep(2);
            }
        }
    }

    read(descriptor, list, count, position) {
        const file = this.find(descriptor);
        if (file.folder)
            throw new SystemError('EISDIR');
        if (file.random)
            return this.transfer(list, count, bytes => createRequire(import.meta.url)('node:crypto').randomFillSync(bytes).length);
        if (file.real === 0 && this.input)
            return this.transfer(list, count, bytes => this.readInput(bytes));
        return this.move(fs.readSync, file, list, count, position);
    }

    readInput(bytes) {
        while (this.input.length === 0)
            this.listen();
        const [block] = this.input, moved = Math.min(block.length, bytes.length);
        bytes.set(block.subarray(0, moved));
        if (moved < block.length)
            this.input[0] = block.subarray(moved);
        else if (moved > 0)
            this.input.shift();
        return moved;
    }

    write(descriptor, list, count, position) {
        return this.move(fs.writeSync, this.find(descriptor), list, count, position);
    }

    // Reads or writes at `position`; null or undefined: at the position of the file, which then advances.
    move(operation, file, list, count, position) {
        return this.transfer(list, count, bytes => {
            const at = position ?? file.position;
            const moved = this.patiently(() => operation(file.real, bytes, 0, bytes.length, at));
            if (position !== null && position !== undefined)
                position += moved;
            else if (file.position !== null)
                file.position += moved;
            return moved;
        });
    }

    seek(descriptor, offset, whence) {
        const file = this.find(descriptor);
        if (file.position === null)
            throw new SystemError('ESPIPE');
        const base = whence === 0 ? 0 : whence === 1 ? file.position : fs.fstatSync(file.real).size;
        if (base + offset < 0)
            throw new SystemError('EINVAL');
        return (file.position = base + offset);
    }

    // Writes entries of a folder as `struct dirent`. Returns the number of bytes.
    readFolder(descriptor, at, length) {
        const file = this.find(descriptor);
        if (!file.folder)
            throw new SystemError('ENOTDIR');
        const encoding = this.windows ? 'utf8' : 'buffer';
        file.entries ??= this.below(descriptor, '.', path => fs.readdirSync(path, { encoding, withFileTypes: true })).map(entry =>
            [this.paths.fromSystem(entry.name), entry.isDirectory() ? 4 : entry.isFile() ? 8 : entry.isSymbolicLink() ? 10 : 0]);
        const size = 280, view = this.view;
        let used = 0;
        for (; file.entries.length && used + size <= length; used += size) {
            const [name, type] = file.entries.shift(), entry = (at >>> 0) + used;
            this.bytes(entry, size).fill(0);
            view.setBigUint64(entry, 1n, true);
            view.setUint16(entry + 16, size, true);
            view.setUint8(entry + 18, type);
            this.bytes(entry + 19, 256).set(Buffer.from(name, 'latin1').subarray(0, 255));
        }
        return used;
    }

    // --- processes, signals and time

    // Delivers a signal that the launcher has received. Without a handler, the signal ends the command. Returns true if there was a signal.
    deliver() {
        const number = this.pending();
        if (number && this.wasm.raise_signal(number) < 0)
            throw new Exit(128 + number, number);
        return number !== 0;
    }

    // Starts another instance. Returns its process id.
    launch(job) {
        if (!this.start)
            throw new SystemError('ENOSYS');
        this.start({ id: ++this.lastPid, ...job });
        this.running.add(this.lastPid);
        return this.lastPid;
    }

    // Waits for a message of another instance or of the launcher, unless `wait` is false. Returns false after a signal, or if there is no
    // message.
    listen(wait = true) {
        for (;;) {
            if (this.deliver())
                return false;
            const message = this.receive(wait);
            if (message?.input)
                this.input.push(message.input);
            else if (message?.result)
                this.results.push(message.result);
            else if (message && this.running.delete(message.id))
                this.ended.push({ pid: message.id, status: message.status });
            if (message || !wait)
                return !!message;
        }
    }

    wait(pid) {
        for (;;) {
            const index = this.ended.findIndex(child => pid < 0 || child.pid === pid);
            if (index >= 0)
                return this.ended.splice(index, 1)[0];
            if (this.running.size === 0)
                throw new SystemError('ECHILD');
            this.listen();
        }
    }

    poll(list, count, timeout) {
        this.deliver();
        if (count === 0 && timeout !== 0)
            sleep(timeout < 0 ? 2 ** 30 : timeout);
        let ready = 0;
        while (this.input && this.listen(false));
        for (let i = 0; i < count; i++) {
            // Node.js cannot ask whether input is there, so that reading may wait, unless the launcher sends the input.
            const at = (list >>> 0) + 8 * i, descriptor = this.view.getInt32(at, true);
            const isEmpty = this.input?.length === 0 && this.files.get(descriptor)?.real === 0;
            const wanted = descriptor >= 0 && !isEmpty ? this.view.getInt16(at + 4, true) : 0;
            this.view.setInt16(at + 6, wanted & 5, true);
            ready += wanted & 5 ? 1 : 0;
        }
        return ready;
    }

    time(clock) {
        this.deliver();
        return clock === 0 ? BigInt(Date.now()) * 1000000n : clock === 1 ? process.hrtime.bigint()
            : BigInt(process.cpuUsage().user) * 1000n;
    }

    // --- imports

    // Returns functions by name. Those that start with `__syscall_` return a negative number for an error, the others a positive number.
    functions() {
        const stat = (call, folder, path, at) => this.below(folder, path, system => this.setStat(at, call(system, { bigint: true })));
        const at = (call, folder, path, ...more) => this.below(folder, path, system => (call(system, ...more), 0));
        const remove = (folder, path, flags) => at(flags & AT_REMOVEDIR ? fs.rmdirSync : fs.unlinkSync, folder, path);
        const rename = (from, old, to, name) =>
            this.below(from, old, source => this.below(to, name, target => (fs.renameSync(source, target), 0)));
        const setText = (address, length, text) => {
            this.bytes(address, length).set(Buffer.from(text, 'latin1').subarray(0, length));
            return Math.min(length, text.length);
        };
        const link = (folder, path, address, length) =>
            setText(address, length, this.below(folder, path, system =>
                this.paths.fromSystem(fs.readlinkSync(system, { encoding: this.windows ? 'utf8' : 'buffer' }))));
        // The mode of a created file follows the arguments of open as variadic arguments, in memory.
        const mode = (flags, more) => (flags & CREATE ? this.view.getUint32(more >>> 0, true) : 0);
        const calls = {
            openat: (folder, path, flags, more) => this.open(folder, this.string(path), flags, mode(flags, more)),
            stat64: (path, to) => stat(fs.statSync, AT_FDCWD, this.string(path), to),
            lstat64: (path, to) => stat(fs.lstatSync, AT_FDCWD, this.string(path), to),
            fstatat64: (folder, path, to, flags) =>
                stat(flags & AT_SYMLINK_NOFOLLOW ? fs.lstatSync : fs.statSync, folder, this.string(path), to),
            fstat64: (descriptor, to) => {
                const file = this.find(descriptor);
                return this.setStat(to, file.real >= 0 ? fs.fstatSync(file.real, { bigint: true })
                    : fs.statSync(this.paths.toSystem(file.path), { bigint: true }));
            },
            access: (path, wanted) => at(fs.accessSync, AT_FDCWD, this.string(path), wanted),
            faccessat: (folder, path, wanted) => at(fs.accessSync, folder, this.string(path), wanted),
            mkdir: (path, permissions) => at(fs.mkdirSync, AT_FDCWD, this.string(path), permissions),
            mkdirat: (folder, path, permissions) => at(fs.mkdirSync, folder, this.string(path), permissions),
            rmdir: path => remove(AT_FDCWD, this.string(path), AT_REMOVEDIR),
            unlink: path => remove(AT_FDCWD, this.string(path), 0),
            unlinkat: (folder, path, flags) => remove(folder, this.string(path), flags),
            rename: (old, name) => rename(AT_FDCWD, this.string(old), AT_FDCWD, this.string(name)),
            renameat: (from, old, to, name) => rename(from, this.string(old), to, this.string(name)),
            linkat: (from, old, to, name) => this.below(from, this.string(old), source =>
                this.below(to, this.string(name), target => (fs.linkSync(source, target), 0))),
            readlink: (path, to, length) => link(AT_FDCWD, this.string(path), to, length),
            readlinkat: (folder, path, to, length) => link(folder, this.string(path), to, length),
            chmod: (path, permissions) => at(fs.chmodSync, AT_FDCWD, this.string(path), permissions),
            fchmod: (descriptor, permissions) => (fs.fchmodSync(this.find(descriptor).real, permissions), 0),
            fchown32: () => 0,
            ftruncate64: (descriptor, low, high) =>
                (fs.ftruncateSync(this.find(descriptor).real, (low >>> 0) + high * 2 ** 32), 0),
            fdatasync: descriptor => (fs.fdatasyncSync(this.find(descriptor).real), 0),
            getdents64: (descriptor, to, length) => this.readFolder(descriptor, to, length),
            getcwd: (to, length) =>
                (setText(to, length, `${this.folder}\0`) > this.folder.length ? this.folder.length + 1 : -ERRORS.ERANGE),
            poll: (list, count, timeout) => this.poll(list, count, timeout),
            dup: descriptor => this.duplicate(descriptor, 0),
        };
        const set = (address, value) => (this.view.setUint32(address >>> 0, value, true), 0);
        const setLong = (address, value) => (this.view.setBigInt64(address >>> 0, BigInt(value), true), 0);
        const setList = (list, buffer, strings) => {
            for (const text of strings) {
                set(list, buffer);
                buffer += setText(buffer, text.length + 1, `${text}\0`);
                list += 4;
            }
            return 0;
        };
        const sizes = (count, size, strings) =>
            set(count, strings.length) || set(size, strings.reduce((sum, text) => sum + text.length + 1, 0));
        const wasi = {
            fd_read: (descriptor, list, count, moved) => set(moved, this.read(descriptor, list, count)),
            fd_pread: (descriptor, list, count, position, moved) => set(moved, this.read(descriptor, list, count, Number(position))),
            fd_write: (descriptor, list, count, moved) => set(moved, this.write(descriptor, list, count)),
            fd_pwrite: (descriptor, list, count, position, moved) => set(moved, this.write(descriptor, list, count, Number(position))),
            fd_seek: (descriptor, offset, whence, result) => setLong(result, this.seek(descriptor, Number(offset), whence)),
            fd_close: descriptor => (this.close(descriptor), 0),
            fd_sync: descriptor => {
                const file = this.find(descriptor);
                if (file.real >= 0)
                    fs.fsyncSync(file.real);
                return 0;
            },
            fd_fdstat_get: (descriptor, to) => {
                const file = this.find(descriptor);
                const type = file.folder ? DIRECTORY : isatty(file.real) ? CHARACTER_DEVICE : REGULAR;
                this.bytes(to, 24).fill(0);
                this.view.setUint8(to >>> 0, type);
                return 0;
            },
            clock_time_get: (clock, precision, to) => setLong(to, this.time(clock)),
            clock_res_get: (clock, to) => setLong(to, 1000),
            args_sizes_get: (count, size) => sizes(count, size, this.args),
            args_get: (list, buffer) => setList(list, buffer, this.args),
            environ_sizes_get: (count, size) => sizes(count, size, this.environment),
            environ_get: (list, buffer) => setList(list, buffer, this.environment),
            proc_exit: status => {
                throw new Exit(status & 255);
            },
        };
        const own = {
            terminal_size: (descriptor, to) => {
                const [columns, rows] = isatty(this.find(descriptor).real) ? this.terminal : [0, 0];
                set(to, columns);
                set(to + 4, rows);
                return columns ? 0 : -ERRORS.ENOTTY;
            },
            duplicate: (descriptor, min) => this.duplicate(descriptor, min),
            descriptor_flags: descriptor => (this.find(descriptor), 0),
            end_by_signal: number => {
                throw new Exit(128 + number, number);
            },
            execute: (program, argv) => {
                const name = this.string(program).split('/').at(-1);
                if (!/^petri-\w+$/.test(name) || !fs.existsSync(new URL(`./${name}.wasm`, import.meta.url)))
                    throw new SystemError('ENOENT');
                throw new Execution(name, this.strings(argv));
            },
            processors: () => os.availableParallelism?.() ?? os.cpus().length,
            start: (folder, argv, output, errors) => this.launch({
                folder: this.realPath(this.paths.toSystem(joinPath(this.folder, this.string(folder)))),
                args: this.strings(argv), output: this.find(output).real, errors: this.find(errors).real,
            }),
            wait: (pid, to) => {
                const child = this.wait(pid);
                set(to, child.status);
                return child.pid;
            },
            start_helpers: (count, list, length) => {
                const runs = new Int32Array(new SharedArrayBuffer(4 * (length + 1))); // the index of the next run, and the runs
                runs.set(new Int32Array(this.wasm.memory.buffer, list, length), 1);
                for (let i = 0; i < count; i++)
                    this.launch({ folder: this.folder, args: this.args, runs });
                return 0;
            },
            is_helper: () => (this.runs ? 1 : 0),
            take_run: () => {
                const index = Atomics.add(this.runs, 0, 1) + 1;
                return index < this.runs.length ? this.runs[index] : -1;
            },
            send: (bytes, length) => this.send({ result: this.bytes(bytes, length).slice() }),
            receive: () => {
                while (this.results.length === 0 && this.running.size > 0 && this.listen());
                return this.results.length > 0 ? this.results[0].length : -1;
            },
            read: bytes => {
                const result = this.results.shift();
                this.bytes(bytes, result.length).set(result);
            },
        };
        const catching = (call, sign) => (...values) => {
            try {
                return call(...values);
            } catch (error) {
                if (error instanceof RangeError || error instanceof WebAssembly.RuntimeError || !error.code)
                    throw error;
                return sign * (ERRORS[error.code] ?? ERRORS.EIO);
            }
        };
        const all = {};
        for (const [name, call] of Object.entries(calls))
            all[`__syscall_${name}`] = catching(call, -1);
        for (const [name, call] of Object.entries(own))
            all[name] = catching(call, -1);
        for (const [name, call] of Object.entries(wasi))
            all[name] = catching(call, 1);
        return all;
    }
}

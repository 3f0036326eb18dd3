// archive.mjs: archives of runs. An archive is an SQLite database, which the engine reads through sql.js (https://sql.js.org).
import { callEngine } from './call.mjs';

const APPLICATION_ID = 0x50745269; // "PtRi"
const ROW = 100, DONE = 101, CORRUPT = 11; // results of SQLite
const INTEGER = 1, FLOAT = 2, TEXT = 3, BLOB = 4, NULL = 5; // types of SQLite
const encoder = new TextEncoder();

// The statements of all databases, by number, for the functions host_sql_... of src/web/host.h.
export class Statements {
    constructor() {
        this.last = 0;
        this.all = new Map();
    }

    prepare(database, sql) {
        try {
            this.all.set(++this.last, { own: database.prepare(sql), values: [], row: null, begun: false });
            return this.last;
        } catch {
            return 0;
        }
    }

    finalize(number) {
        this.all.get(number).own.free();
        this.all.delete(number);
    }

    bind(number, parameter, value) {
        this.all.get(number).values[parameter - 1] = value;
    }

    step(number) {
        const statement = this.all.get(number);
        try {
            if (!statement.begun)
                statement.own.bind(statement.values);
            statement.begun = true;
            statement.row = statement.own.step() ? statement.own.get(null, { useBigInt: true }) : null;
            return statement.row ? ROW : DONE;
        } catch {
            statement.row = null;
            return CORRUPT;
        }
    }

    reset(number) {
        const statement = this.all.get(number);
        statement.own.reset();
        Object.assign(statement, { values: [], row: null, begun: false });
    }

    value(number, column) {
        return this.all.get(number).row?.[column] ?? null;
    }

    type(number, column) {
        const value = this.value(number, column);
        return value === null ? NULL : typeof value === 'bigint' ? INTEGER : typeof value === 'number' ? FLOAT
            : typeof value === 'string' ? TEXT : BLOB;
    }

    integer(number, column) {
        const value = this.value(number, column);
        return typeof value === 'bigint' ? value : 0n;
    }

    bytes(number, column) {
        const value = this.value(number, column);
        return typeof value === 'string' ? encoder.encode(value) : value instanceof Uint8Array ? value : new Uint8Array();
    }
}

// An archive that is replayed. petri.d.ts documents it.
export class Archive {
    constructor(engine, database, memory) {
        Object.assign(this, { engine, database });
        if (database.exec('PRAGMA application_id')[0]?.values[0][0] !== APPLICATION_ID)
            throw new Error('cannot read the archive: it is not an archive');
        database.run('PRAGMA trusted_schema = OFF');
        this.handle = this.run(wasm => wasm.web_archive_open(memory));
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

// sqlite.mjs: SQLite for archives (sql.js). The worker loads this file when the first archive is opened.
import initSqlJs from 'sql.js';

const answer = await fetch(new URL('./sql-wasm.wasm', import.meta.url));
if (!answer.ok)
    throw new Error(`cannot load SQLite: ${answer.url} returned status ${answer.status}`);
const { Database } = await initSqlJs({ wasmBinary: await answer.arrayBuffer() });

export const openDatabase = bytes => new Database(bytes);

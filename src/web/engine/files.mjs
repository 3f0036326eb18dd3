// files.mjs: the files that scripts can read in `petri view`, in `petri render` and in the preview of VS Code.
import fs from 'node:fs';
import { join, relative, sep } from 'node:path';

const MAX_FILES = 200, MAX_BYTES = 1 << 20, MAX_DEPTH = 3;

const textOf = bytes => {
    const text = bytes.toString();
    return !bytes.includes(0) && Buffer.from(text).equals(bytes) ? text : null;
};

// Calls a function that reads files, and returns its result; null if the operating system reports an error.
const unlessUnreadable = action => {
    try {
        return action();
    } catch (error) {
        if (!error.code)
            throw error;
        return null;
    }
};

// Returns the text files below a folder that a script can read, by their paths relative to the folder. Follows no symbolic links. `read`
// returns the value for a file's bytes and name, or null to omit the file. Omits files and folders below `folder` that cannot be read.
export function filesBelow(folder, read = textOf, top = folder, depth = 0, found = {}) {
    for (const entry of fs.readdirSync(folder, { withFileTypes: true })) {
        const path = join(folder, entry.name);
        if (entry.name.startsWith('.') || entry.name === 'node_modules' || Object.keys(found).length >= MAX_FILES)
            continue;
        if (entry.isDirectory() && depth < MAX_DEPTH) {
            unlessUnreadable(() => filesBelow(path, read, top, depth + 1, found));
        } else if (entry.isFile()) {
            const bytes = unlessUnreadable(() => fs.statSync(path).size <= MAX_BYTES && fs.readFileSync(path));
            const value = bytes ? read(bytes, entry.name) : null;
            if (value !== null)
                found[relative(top, path).replaceAll(sep, '/')] = value;
        }
    }
    return found;
}

// paths.mjs: paths of the operating system as the POSIX paths that petri-command.wasm uses. Strings hold one byte per character, because
// POSIX names need not be UTF-8. `C:\dir\a.fl` is `/C:/dir/a.fl`, `\\server\share\a.fl` is `//server/share/a.fl`.
import nodePath from 'node:path';

const toBytes = text => Buffer.from(text).toString('latin1');
const toText = bytes => Buffer.from(bytes, 'latin1').toString();

export const posixPaths = {
    // Converts an absolute POSIX path to the form that node:fs takes.
    toSystem: path => Buffer.from(path, 'latin1'),
    // Converts a path of the system, such as the working directory.
    fromSystem: path => (typeof path === 'string' ? toBytes(path) : path.toString('latin1')),
    // Converts an argument of the command line.
    fromArgument: argument => toBytes(argument),
};

const DRIVE = /^[A-Za-z]:(?=[\\/]|$)/;

export const windowsPaths = {
    toSystem(path) {
        const text = toText(path);
        if (text === '/dev/null')
            return '\\\\.\\nul';
        const drive = /^\/([A-Za-z]:)(\/.*)?$/.exec(text);
        return drive ? nodePath.win32.normalize(`${drive[1]}${drive[2] ?? '/'}`) : nodePath.win32.normalize(text);
    },
    fromSystem(path) {
        const text = String(path).replace(/^\\\\\?\\(?:UNC\\)?/, match => (match.includes('UNC') ? '\\\\' : '')).replaceAll('\\', '/');
        return toBytes(DRIVE.test(text) ? `/${text}` : text);
    },
    // Converts a path in an argument, also after `--option=`. Backslashes of relative paths are converted if `exists` finds the file or its
    // folder, because the text of a definition may contain backslashes, too.
    fromArgument(argument, exists) {
        const [, option, value] = /^(--[a-z-]+=)?([^]*)$/.exec(argument);
        const isPath = DRIVE.test(value) || value.startsWith('\\\\')
            || (value.includes('\\') && (exists(value) || exists(nodePath.win32.dirname(value))));
        return toBytes(option ?? '') + (isPath ? this.fromSystem(value) : toBytes(value));
    },
};

// Joins a POSIX path to a folder and removes `.`, but not `..`, which the system resolves after symbolic links.
export function joinPath(folder, path) {
    return path.startsWith('/') ? path : `${folder === '/' ? '' : folder}/${path}`;
}

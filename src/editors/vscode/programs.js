// programs.js: the programs that the extension starts: the installed petri, or the bundled one in WebAssembly.
const fs = require("fs");
const path = require("path");
const vscode = require("vscode");

const setting = (name) => vscode.workspace.getConfiguration("petri").get(name);

// Returns the path of a program, or null if it is not in PATH. A name with a slash is a path.
function findProgram(name) {
    const folders = /[\\/]/.test(name) ? [""] : (process.env.PATH ?? "").split(path.delimiter).filter(Boolean);
    const suffixes = process.platform === "win32" ? ["", ...(process.env.PATHEXT ?? ".EXE;.CMD").split(";")] : [""];
    const isProgram = (file) => {
        try {
            fs.accessSync(file, fs.constants.X_OK);
            return fs.statSync(file).isFile();
        } catch {
            return false;
        }
    };
    return folders.flatMap((folder) => suffixes.map((suffix) => path.join(folder, name + suffix))).find(isProgram) ?? null;
}

// Returns { command, args, env } of the bundled command. VS Code's own program runs it as Node.js.
const bundled = (context) => ({
    command: process.execPath,
    args: [path.join(context.extensionPath, "engine", "cli.mjs")],
    env: { ...process.env, ELECTRON_RUN_AS_NODE: "1" },
});

// Returns { command, args, env } of the installed command, or null if there is none.
function installed() {
    const command = findProgram(setting("path"));
    return command && { command, args: [], env: process.env };
}

module.exports = { bundled, installed, setting };

// extension.js: the VS Code extension, which starts `petri lsp` and provides commands that run, view and draw scripts.
const childProcess = require("child_process");
const os = require("os");
const path = require("path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;
let panel; // the panel that shows the picture; undefined: closed
let shown; // path of the script whose picture is in the panel
const socket = path.join(os.tmpdir(), `petri-vscode-${process.pid}`); // for `petri view --listen`

const setting = (name) => vscode.workspace.getConfiguration("petri").get(name);

async function startServer() {
    await client?.stop();
    client = new LanguageClient(
        "petri",
        "petri",
        { command: setting("path"), args: ["lsp", ...setting("arguments")] },
        {
            documentSelector: [{ language: "flitter" }],
            synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/*.fl") },
        },
    );
    try {
        await client.start();
    } catch (problem) {
        vscode.window.showErrorMessage(`Cannot start petri lsp: ${problem.message}. Check the setting "petri.path".`);
    }
}

// Saves the script in the active editor and returns its path. If there is no script, shows a message and returns undefined.
async function script() {
    const document = vscode.window.activeTextEditor?.document;
    if (document?.languageId !== "flitter" || document.uri.scheme !== "file") {
        vscode.window.showErrorMessage("The active editor has no Flitter script that is saved as a file.");
        return undefined;
    }
    await document.save();
    return document.fileName;
}

async function inTerminal(command, ...options) {
    const file = await script();
    if (file) {
        const terminal = vscode.window.createTerminal({
            name: `petri ${command}`,
            cwd: path.dirname(file),
            shellPath: setting("path"),
            shellArgs: [command, file, ...options],
        });
        terminal.show(true);
    }
}

// Evaluates code in the view and shows the result.
function send(text) {
    childProcess.execFile(setting("path"), ["send", socket, text], { timeout: 10000 }, (problem, out, said) => {
        const answers = out.split("\n").filter(Boolean).map((line) => JSON.parse(line).text).filter(Boolean);
        const show = problem ? vscode.window.showErrorMessage : vscode.window.setStatusBarMessage;
        show(answers.join("; ") || (problem ? said : "done"), problem ? undefined : 10000);
    });
}

// Sends the selection, or the current line if the selection is empty.
function sendSelection() {
    const editor = vscode.window.activeTextEditor;
    send(editor?.document.getText(editor.selection.isEmpty
        ? editor.document.lineAt(editor.selection.active.line).range : editor.selection) ?? "");
}

const escaped = (text) => text.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);

// Draws a frame with `petri render` in the panel. On failure, shows the error message there.
function draw() {
    const args = ["render", shown, "-o", "-", "--format", "png", "--frame", String(setting("frame"))];
    const options = { encoding: "buffer", maxBuffer: 1 << 28, cwd: path.dirname(shown), timeout: 60000 };
    const file = shown;
    childProcess.execFile(setting("path"), args, options, (problem, picture, said) => {
        if (panel && file === shown) {
            const body = problem
                ? `<pre>${escaped(said.toString() || problem.message)}</pre>`
                : `<img style="max-width: 100%" src="data:image/png;base64,${picture.toString("base64")}">`;
            panel.webview.html = `<!DOCTYPE html><html><body>${body}</body></html>`;
        }
    });
}

async function showPicture() {
    const file = await script();
    if (!file) {
        return;
    }
    shown = file;
    panel ??= vscode.window.createWebviewPanel("petri.picture", "petri", vscode.ViewColumn.Beside, {});
    panel.onDidDispose(() => (panel = undefined));
    panel.title = path.basename(file);
    draw();
}

async function activate(context) {
    context.subscriptions.push(
        vscode.commands.registerCommand("petri.view", () => inTerminal("view", "--listen", socket)),
        vscode.commands.registerCommand("petri.send", sendSelection),
        vscode.commands.registerCommand("petri.back", () => send(".back 60")),
        vscode.commands.registerCommand("petri.run", () => inTerminal("run")),
        vscode.commands.registerCommand("petri.picture", showPicture),
        vscode.commands.registerCommand("petri.restart", startServer),
        vscode.workspace.onDidSaveTextDocument((document) => {
            if (panel && document.languageId === "flitter") {
                draw();
            }
        }),
    );
    await startServer();
}

module.exports = { activate, deactivate: () => client?.stop() };

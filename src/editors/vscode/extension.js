// extension.js: the VS Code extension: starts the language server, and provides commands that run, view and preview scripts.
const childProcess = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");
const vscode = require("vscode");
const { PreviewPanel, isScript } = require("./preview_panel");
const programs = require("./programs");
const { Server } = require("./server");

let server;
const socket = path.join(os.tmpdir(), `petri-vscode-${process.pid}`); // for `petri view --listen`

// Returns the script in the active editor. If there is none, shows a message and returns undefined.
function script() {
    const document = vscode.window.activeTextEditor?.document;
    if (document && isScript(document))
        return document;
    vscode.window.showErrorMessage("The active editor has no Flitter script.");
    return undefined;
}

// Returns the installed command. If there is none, shows a message and returns null.
async function installed(purpose) {
    const program = programs.installed();
    const preview = "Show Preview";
    if (!program && (await vscode.window.showWarningMessage(
        `${purpose} needs petri to be installed, but '${programs.setting("path")}' was not found.`, preview)) === preview)
        vscode.commands.executeCommand("petri.preview");
    return program;
}

// Returns the script of a code lens, which passes its URI as a text, or the script in the active editor.
const scriptOf = (uri) => (typeof uri === "string" ? vscode.workspace.openTextDocument(vscode.Uri.parse(uri)) : script());

// Saves a script and runs `petri COMMAND` with it in a terminal, which stays open at the end. Returns the task, or undefined
// if there is no script or it is not a file.
async function runTask(command, program, document, ...options) {
    if (!document)
        return undefined;
    if (document.uri.scheme !== "file" || (document.isDirty && !(await document.save()))) {
        vscode.window.showErrorMessage("The script is not saved as a file.");
        return undefined;
    }
    const file = document.fileName, env = program.env.ELECTRON_RUN_AS_NODE ? { ELECTRON_RUN_AS_NODE: "1" } : {};
    const words = [...program.args, command, file, ...options];
    const execution = new vscode.ProcessExecution(program.command, words, { cwd: path.dirname(file), env });
    const task = new vscode.Task({ type: "petri" }, vscode.TaskScope.Workspace, `${command} ${path.basename(file)}`, "petri", execution);
    task.presentationOptions = { clear: true, showReuseMessage: false };
    await vscode.tasks.executeTask(task);
    return task;
}

// Draws a script to a PNG file beside it, and shows the file.
async function render(program, document) {
    const picture = document?.fileName.replace(/(\.fl)?$/, ".png");
    const task = await runTask("render", program, document, "-o", picture);
    const listener = task && vscode.tasks.onDidEndTaskProcess(({ execution, exitCode }) => {
        if (execution.task.name !== task.name)
            return;
        listener.dispose();
        if (exitCode === 0)
            vscode.commands.executeCommand("vscode.open", vscode.Uri.file(picture));
    });
}

async function view() {
    const program = await installed("The window");
    if (program)
        await runTask("view", program, script(), "--listen", socket);
}

// Evaluates code in the view and shows the result.
async function send(text) {
    const program = await installed("The window");
    if (!program)
        return;
    childProcess.execFile(program.command, ["send", socket, text], { timeout: 10000 }, (problem, out, said) => {
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

async function activate(context) {
    server = new Server(context);
    const preview = new PreviewPanel(context), program = () => programs.installed() ?? programs.bundled(context);
    const showPreview = () => {
        const document = script();
        if (document)
            preview.show(document);
    };
    // Shows an unsaved copy of the sample with its preview.
    const showSample = async () => {
        const content = fs.readFileSync(path.join(context.extensionPath, "dish.fl"), "utf8");
        const document = await vscode.workspace.openTextDocument({ language: "flitter", content });
        await vscode.window.showTextDocument(document);
        preview.show(document);
    };
    context.subscriptions.push(
        vscode.commands.registerCommand("petri.preview", showPreview),
        vscode.commands.registerCommand("petri.view", view),
        vscode.commands.registerCommand("petri.send", sendSelection),
        vscode.commands.registerCommand("petri.back", () => send(".back 60")),
        vscode.commands.registerCommand("petri.run", async (uri) => runTask("run", program(), await scriptOf(uri))),
        vscode.commands.registerCommand("petri.render", async (uri) => render(program(), await scriptOf(uri))),
        vscode.commands.registerCommand("petri.test", async (uri) => runTask("test", program(), await scriptOf(uri))),
        vscode.commands.registerCommand("petri.restart", () => server.start()),
        vscode.commands.registerCommand("petri.sample", showSample),
        vscode.workspace.onDidChangeConfiguration((change) => change.affectsConfiguration("petri") && server.start()),
    );
    await server.start();
}

module.exports = { activate, deactivate: () => server?.stop() };

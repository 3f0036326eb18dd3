// server.js: the language server, and the item in the status bar that names it.
const childProcess = require("child_process");
const vscode = require("vscode");
const { CloseAction, ErrorAction, LanguageClient } = require("vscode-languageclient/node");
const programs = require("./programs");

const MAX_RESTARTS = 4;

// Returns true if the installed command has the language server. Older builds without json-c lack it.
const hasServer = ({ command }) =>
    new Promise((resolve) => childProcess.execFile(command, ["lsp", "--help"], { timeout: 10000 }, (problem) => resolve(!problem)));

// A client that is starting or has failed to start cannot be stopped: LanguageClient throws an error.
class Client extends LanguageClient {
    stop(timeout) {
        return super.stop(timeout).catch(() => {});
    }
}

class Server {
    constructor(context) {
        this.context = context;
        this.client = null;
        this.last = Promise.resolve();
        this.status = vscode.languages.createLanguageStatusItem("petri.server", { language: "flitter" });
        this.status.name = "petri";
        this.status.command = { command: "petri.restart", title: "Restart" };
        context.subscriptions.push(this.status);
    }

    show(text, detail, severity = "Information") {
        Object.assign(this.status, { text, detail, severity: vscode.LanguageStatusSeverity[severity], busy: false });
    }

    // Starts the server, or restarts it, also after a failed start.
    start() {
        return (this.last = this.last.then(() => this.restart()));
    }

    async restart() {
        await this.stop();
        this.status.busy = true;
        const found = programs.installed(), isInstalled = found && (await hasServer(found));
        const { command, args, env } = isInstalled ? found : programs.bundled(this.context);
        let restarts = null; // how often the server may still be restarted; null until it has started
        const errorHandler = {
            error: () => ({ action: ErrorAction.Continue }),
            closed: () => {
                if (restarts === null)
                    return { action: CloseAction.DoNotRestart, handled: true };
                if (restarts-- > 0)
                    return { action: CloseAction.Restart };
                this.show("petri: no server", "the server has ended several times", "Error");
                return { action: CloseAction.DoNotRestart };
            },
        };
        this.client = new Client(
            "petri",
            "petri",
            { command, args: [...args, "lsp", ...programs.setting("arguments")], options: { env } },
            { documentSelector: [{ language: "flitter" }], errorHandler,
                initializationFailedHandler: () => false,
                initializationOptions: { commands: ["petri.run", "petri.render", "petri.test"] } }, // for code lenses
        );
        const problem = await this.client.start().then(() => null, ({ message }) => message);
        if (problem || !this.client.isRunning()) {
            const name = isInstalled ? command : "the bundled petri", reason = problem ?? "the server has ended";
            this.show("petri: no server", `${name}: ${reason}`, "Error");
            vscode.window.showErrorMessage(`Cannot start ${name}: ${reason}. Check the settings petri.path and petri.arguments.`);
            return;
        }
        restarts = MAX_RESTARTS;
        const version = this.client.initializeResult?.serverInfo?.version ?? "";
        if (isInstalled)
            this.show(`petri ${version}`, command);
        else
            this.show(`petri ${version} in WebAssembly`, `bundled, because ${
                found ? `${found.command} has no language server` : `'${programs.setting("path")}' was not found`}`);
    }

    async stop() {
        const { client } = this;
        this.client = null;
        await client?.stop();
    }
}

module.exports = { Server };

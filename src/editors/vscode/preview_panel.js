// preview_panel.js: the panel that shows the moving picture of a script. preview.mjs is its page.
const { randomBytes } = require("crypto");
const fs = require("fs");
const path = require("path");
const vscode = require("vscode");
const { filesBelow } = require("../../web/engine/files.mjs");

const isScript = (document) => document.languageId === "flitter";
const encoder = new TextEncoder();

class PreviewPanel {
    constructor(context) {
        this.context = context;
        this.panel = null;
        this.document = null; // the script whose picture is shown
        context.subscriptions.push(
            vscode.workspace.onDidChangeTextDocument(({ document }) => this.changed(document)),
            vscode.workspace.onDidSaveTextDocument(() => this.send(this.readFiles())),
        );
    }

    // Shows the picture of a script instead of the current one.
    show(document) {
        this.document = document;
        if (this.panel) {
            this.panel.reveal(undefined, true);
            this.send(this.readFiles());
        } else {
            this.open();
        }
        this.panel.title = `Preview ${path.basename(document.fileName)}`;
    }

    open() {
        const roots = ["dist", "engine"].map((folder) => vscode.Uri.joinPath(this.context.extensionUri, folder));
        this.panel = vscode.window.createWebviewPanel("petri.preview", "Preview",
            { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
            { enableScripts: true, retainContextWhenHidden: true, localResourceRoots: roots });
        this.panel.onDidDispose(() => (this.panel = this.document = null));
        this.panel.webview.onDidReceiveMessage((message) => this.receive(message));
        this.panel.webview.html = this.page(this.panel.webview);
    }

    page(webview) {
        const nonce = randomBytes(16).toString("hex");
        const uri = (...names) => webview.asWebviewUri(vscode.Uri.joinPath(this.context.extensionUri, ...names));
        return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'nonce-${nonce}' 'wasm-unsafe-eval'; style-src ${
    webview.cspSource}; connect-src ${webview.cspSource}; worker-src blob:; img-src blob: data:">
<title>Preview</title>
<link rel="stylesheet" href="${uri("dist", "style.css")}">
</head>
<body data-engine="${uri("engine", "engine.wasm")}" data-worker="${uri("dist", "worker.js")}">
<main>
<div id="frame"><canvas id="picture" tabindex="0" width="300" height="150" aria-label="The picture of the script"></canvas></div>
<p id="message" role="status"></p>
<ul id="problems"></ul>
<div id="below"></div>
<section id="particle" aria-label="Particle" hidden>
<output id="particle-title"></output>
<p id="particle-origin"></p>
<pre id="particle-state"></pre>
<table>
<thead><tr><th scope="col">force</th><th scope="col">from</th><th scope="col">contribution</th><th scope="col">script</th></tr></thead>
<tbody id="particle-forces"></tbody></table>
</section>
</main>
<script nonce="${nonce}" src="${uri("dist", "preview.js")}"></script>
</body>
</html>`;
    }

    // Returns the files that the script can read, with the unsaved text of scripts that are open in editors.
    readFiles() {
        if (!this.panel || this.document.uri.scheme !== "file")
            return {};
        const folder = path.dirname(this.document.fileName), files = {};
        try {
            Object.assign(files, filesBelow(fs.realpathSync(folder), (bytes) => new Uint8Array(bytes)));
        } catch {
            // The folder does not exist (any more).
        }
        for (const document of vscode.workspace.textDocuments)
            this.addText(files, document);
        return files;
    }

    // Adds the text of another script in the folder of the shown script. Returns false if the document is not one.
    addText(files, document) {
        const name = path.relative(path.dirname(this.document.fileName), document.fileName).split(path.sep).join("/");
        if (!isScript(document) || document.uri.scheme !== "file" || name.startsWith("..") || path.isAbsolute(name))
            return false;
        files[name] = encoder.encode(document.getText());
        return true;
    }

    changed(document) {
        const files = {};
        if (!this.panel)
            return;
        const isShown = document.uri.toString() === this.document.uri.toString();
        if (isShown)
            this.document = document; // another object if the script was closed and opened again
        if (isShown || this.addText(files, document))
            this.send(files);
    }

    // Sends the current text of the script and files to the page.
    send(files) {
        const { document } = this;
        if (document)
            this.panel.webview.postMessage({
                id: document.uri.toString(), name: path.basename(document.fileName), text: document.getText(), files,
            });
    }

    // Returns the shown script, or the script with this name in its folder.
    scriptNamed(file) {
        const folder = path.dirname(this.document.fileName), other = path.resolve(folder, file);
        const isOther = this.document.uri.scheme === "file" && other !== this.document.fileName && other.startsWith(folder + path.sep);
        return isOther ? vscode.Uri.file(other) : this.document;
    }

    async receive({ type, file = "", line, column }) {
        if (type === "ready")
            this.send(this.readFiles());
        if (type === "goTo") {
            const editor = await vscode.window.showTextDocument(this.scriptNamed(file), vscode.ViewColumn.One);
            const at = new vscode.Position(line - 1, column - 1);
            editor.selection = new vscode.Selection(at, at);
            editor.revealRange(new vscode.Range(at, at));
        }
    }
}

module.exports = { PreviewPanel, isScript };

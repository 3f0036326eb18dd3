// index.js: a substitute for the module that VS Code gives to extensions. It records what the extension does in `seen`. Anything else is
// an object whose properties can be read and called.
const path = require("path");
const { pathToFileURL, fileURLToPath } = require("url");

const anything = new Proxy(function () {}, {
    get: (_, name) => (name === Symbol.iterator ? [][Symbol.iterator].bind([]) : name === "then" ? undefined
        : name === "prototype" ? {} : name === Symbol.toPrimitive ? () => "" : anything),
    apply: () => anything,
    construct: () => ({ dispose() {} }),
});
const orAnything = (known) => new Proxy(known, { get: (all, name) => (name in all ? all[name] : anything) });

const none = { dispose() {} };

class Uri {
    constructor(url) {
        this.url = url;
        this.scheme = new URL(url).protocol.slice(0, -1);
    }
    static file(name) {
        return new Uri(pathToFileURL(name).href);
    }
    static parse(text) {
        return new Uri(text);
    }
    static joinPath(uri, ...names) {
        return Uri.file(path.join(uri.fsPath, ...names));
    }
    get fsPath() {
        return fileURLToPath(this.url);
    }
    toString() {
        return this.url;
    }
}

class Event {
    constructor() {
        this.listeners = [];
        this.on = this.event = (listener, owner) => {
            const bound = owner ? listener.bind(owner) : listener;
            this.listeners.push(bound);
            return { dispose: () => (this.listeners = this.listeners.filter((other) => other !== bound)) };
        };
    }
    dispose() {}
    fire(value) {
        this.listeners.forEach((listener) => listener(value));
    }
}

class CancellationTokenSource {
    constructor() {
        this.token = { isCancellationRequested: false, onCancellationRequested: () => none };
    }
    cancel() {
        this.token.isCancellationRequested = true;
    }
    dispose() {}
}

class Position {
    constructor(line, character) {
        Object.assign(this, { line, character });
    }
}
class Range {
    constructor(...all) {
        const [start, end] = all.length === 2 ? all : [new Position(all[0], all[1]), new Position(all[2], all[3])];
        Object.assign(this, { start, end });
    }
}
class Diagnostic {
    constructor(range, message) {
        Object.assign(this, { range, message });
    }
}

// What tests set and read. `origin` is the origin of files in webviews.
const seen = {
    settings: { path: "petri", arguments: [] }, commands: {}, messages: [], statuses: [], diagnostics: {}, panels: [], tasks: [], shown: [],
    origin: "https://files.test", changed: new Event(), saved: new Event(), configured: new Event(), opened: new Event(),
    ended: new Event(),
};

const said = (...words) => {
    seen.messages.push(words[0]);
    return Promise.resolve(seen.answer);
};

module.exports = orAnything({
    seen, CancellationTokenSource, EventEmitter: Event, Uri, Position, Range, Diagnostic,
    Selection: Range,
    ViewColumn: { One: 1, Beside: -2 },
    LanguageStatusSeverity: { Information: 0, Warning: 1, Error: 2 },
    TaskScope: { Workspace: 2 },
    ProcessExecution: class {
        constructor(process, args, options) {
            Object.assign(this, { process, args, options });
        }
    },
    Task: class {
        constructor(definition, scope, name, source, execution) {
            Object.assign(this, { name, execution });
        }
    },
    tasks: orAnything({ executeTask: async (task) => seen.tasks.push(task), onDidEndTaskProcess: seen.ended.on }),
    commands: orAnything({
        registerCommand: (name, act) => {
            seen.commands[name] = act;
            return none;
        },
        executeCommand: (name, ...words) => seen.commands[name](...words),
    }),
    languages: orAnything({
        createLanguageStatusItem: () => {
            const item = {};
            seen.statuses.push(item);
            return item;
        },
        createDiagnosticCollection: () => orAnything({ set: (uri, list) => (seen.diagnostics[uri] = list), dispose() {} }),
        match: (selector, document) => (document.languageId === "flitter" ? 10 : 0),
    }),
    workspace: orAnything({
        getConfiguration: () => orAnything({ get: (name) => seen.settings[name] }),
        textDocuments: [],
        openTextDocument: async ({ url, language, content }) => url ? module.exports.workspace.textDocuments.find(({ uri }) => uri.url === url) : ({
            fileName: "Untitled-1", uri: Uri.parse("untitled:Untitled-1"), languageId: language, version: 1, isDirty: true, text: content,
            getText: () => content,
        }),
        workspaceFolders: undefined,
        onDidChangeTextDocument: seen.changed.on,
        onDidSaveTextDocument: seen.saved.on,
        onDidOpenTextDocument: seen.opened.on,
        onDidChangeConfiguration: seen.configured.on,
    }),
    window: orAnything({
        activeTextEditor: undefined,
        showErrorMessage: said, showWarningMessage: said, setStatusBarMessage: said,
        showTextDocument: async (document) => {
            const editor = { document, revealRange() {} };
            seen.shown.push(editor);
            return editor;
        },
        createWebviewPanel: (type, title, place, options) => {
            const received = new Event(), disposed = new Event(), sent = [];
            const panel = {
                title, place, options, received, disposed, sent, revealed: 0, reveal: () => panel.revealed++,
                onDidDispose: disposed.on,
                webview: {
                    html: "", cspSource: seen.origin, onDidReceiveMessage: received.on,
                    asWebviewUri: (uri) => `${seen.origin}${uri.fsPath}`,
                    postMessage: (message) => {
                        sent.push(message);
                        panel.onSend?.(message);
                    },
                },
            };
            seen.panels.push(panel);
            return panel;
        },
    }),
    env: orAnything({ language: "en" }),
    version: "1.90.0",
});

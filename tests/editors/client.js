// client.js: tests the language server with VS Code's client library. usage: node client.js PETRI
const childProcess = require("child_process");
const assert = require("assert");
const protocol = require("vscode-languageserver-protocol/node");

async function main(petri) {
    const server = childProcess.spawn(petri, ["lsp", "--stdio"]);
    const connection = protocol.createProtocolConnection(
        new protocol.StreamMessageReader(server.stdout), new protocol.StreamMessageWriter(server.stdin));
    const published = new Promise((resolve) => connection.onNotification(protocol.PublishDiagnosticsNotification.type, resolve));
    connection.listen();
    const { capabilities } = await connection.sendRequest(protocol.InitializeRequest.type,
        { processId: process.pid, rootUri: null, capabilities: {} });
    assert(capabilities.hoverProvider && capabilities.renameProvider.prepareProvider);
    await connection.sendNotification(protocol.InitializedNotification.type, {});
    const textDocument = { uri: "file:///tmp/client.fl", languageId: "flitter", version: 1, text: "let a=coz(1)\n!n b=a\n" };
    await connection.sendNotification(protocol.DidOpenTextDocumentNotification.type, { textDocument });
    assert.match((await published).diagnostics[0].message, /did you mean 'cos'/);
    const ask = (kind, more) => connection.sendRequest(kind.type, { textDocument, position: { line: 1, character: 5 }, ...more });
    assert.match((await ask(protocol.HoverRequest)).contents.value, /let a=coz/);
    assert((await ask(protocol.CompletionRequest)).some((item) => item.label === "a"));
    assert.equal((await ask(protocol.DefinitionRequest)).range.start.line, 0);
    assert.equal((await ask(protocol.RenameRequest, { newName: "c" })).changes[textDocument.uri].length, 2);
    assert.equal((await ask(protocol.DocumentSymbolRequest)).length, 2);
    assert((await ask(protocol.SemanticTokensRequest)).data.length > 0);
    await connection.sendRequest(protocol.ShutdownRequest.type);
    await connection.sendNotification(protocol.ExitNotification.type);
    assert.equal(await new Promise((resolve) => server.on("exit", resolve)), 0);
    console.log("all answers are as expected");
}

main(process.argv[2]).catch((problem) => {
    console.error(problem);
    process.exit(1);
});

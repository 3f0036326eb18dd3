"""client.py: a language client for tests, which starts `petri lsp`, sends messages and reads the answers."""

import faulthandler
import json
import subprocess

PATIENCE = 100  # seconds without a message after which a test ends with the line that waits for it


class Client:
    def __init__(self, petri, utf8=False, options=(), root=None, commands=(), watches=False):
        self.process = subprocess.Popen([petri, "lsp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.number = 0
        self.published = {}  # last publishDiagnostics message by URI
        self.requests = []  # requests of the server
        self.versions = {}
        encodings = ["utf-8", "utf-16"] if utf8 else ["utf-16"]
        self.server = self.ask("initialize", {"processId": None, "rootUri": root, "initializationOptions": {"commands": list(commands)}, "capabilities": {
            "general": {"positionEncodings": encodings},
            "workspace": {"didChangeWatchedFiles": {"dynamicRegistration": watches}}}})
        self.notify("initialized", {})

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def read(self):
        faulthandler.dump_traceback_later(PATIENCE, exit=True)
        length = None
        while (line := self.process.stdout.readline().strip()):
            name, value = line.split(b":", 1)
            if name.lower() == b"content-length":
                length = int(value)
        if length is None:
            raise EOFError(f"the server has ended: exit status {self.process.wait()}")
        message = json.loads(self.process.stdout.read(length))
        faulthandler.cancel_dump_traceback_later()
        if "method" in message and "id" in message:
            self.requests.append(message)
            self.send({"id": message["id"], "result": None})
        if message.get("method") == "textDocument/publishDiagnostics":
            self.published[message["params"]["uri"]] = message["params"]
        return message

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def answer(self, number):
        """Returns the answer to a request; for None, the error about a message that could not be parsed."""
        while (message := self.read()).get("id") != number or "method" in message:
            pass
        return message

    def reply(self, method, params):
        """Returns the answer to a request, which may be an error."""
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        return self.answer(self.number)

    def ask(self, method, params):
        message = self.reply(method, params)
        assert "error" not in message, message
        return message["result"]

    def at(self, method, uri, line, character, **more):
        return self.ask("textDocument/" + method, {"textDocument": {"uri": uri}, "position": {
            "line": line, "character": character}, **more})

    def of(self, method, uri, **more):
        return self.ask("textDocument/" + method, {"textDocument": {"uri": uri}, **more})

    def open(self, uri, text):
        self.versions[uri] = 1
        self.notify("textDocument/didOpen", {"textDocument": {
            "uri": uri, "languageId": "flitter", "version": 1, "text": text}})
        return self.wait(uri)

    def change(self, uri, *changes):
        self.versions[uri] += 1
        self.notify("textDocument/didChange", {"textDocument": {
            "uri": uri, "version": self.versions[uri]}, "contentChanges": list(changes)})

    def wait(self, uri):
        """Returns the diagnostics of the current version."""
        while self.published.get(uri, {}).get("version") != self.versions[uri]:
            self.read()
        return self.published[uri]["diagnostics"]

    def tokens(self, path):
        """Yields the line, start, end and kind of each semantic token of a file."""
        uri = path.as_uri()
        self.notify("textDocument/didOpen", {"textDocument": {
            "uri": uri, "languageId": "flitter", "version": 1, "text": path.read_bytes().decode()}})
        data = self.of("semanticTokens/full", uri)["data"]
        self.close(uri)
        legend = self.server["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
        line = start = 0
        for i in range(0, len(data), 5):
            line, start = line + data[i], data[i + 1] + (0 if data[i] else start)
            yield line, start, start + data[i + 2], legend[data[i + 3]]

    def close(self, uri):
        self.notify("textDocument/didClose", {"textDocument": {"uri": uri}})

    def end(self):
        self.ask("shutdown", None)
        self.notify("exit", None)
        self.process.stdin.close()
        return self.process.wait()

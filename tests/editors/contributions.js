// contributions.js: petri accepts the snippets of the VS Code extension, and its problem matcher finds the diagnostics of petri.
// usage: node contributions.js PETRI EXTENSION, in a folder for scripts
const assert = require("assert");
const childProcess = require("child_process");
const fs = require("fs");
const path = require("path");

const [petri, extension] = process.argv.slice(2);
const { contributes } = JSON.parse(fs.readFileSync(path.join(extension, "package.json"), "utf8"));
const run = (...words) => childProcess.spawnSync(petri, words, { encoding: "utf8" });

// Returns a snippet with its default values, as VS Code inserts it in a script indented by 4 spaces.
function expand({ body }) {
    const values = {}, text = [body].flat().join("\n").replaceAll("\t", "    ");
    const filled = text.replace(/\$\{(\d+):([^}]*)\}/g, (_, number, value) => (values[number] = value));
    return filled.replace(/\$(\d+)/g, (_, number) => values[number] ?? (assert.equal(number, "0"), "")) + "\n";
}

const snippets = JSON.parse(fs.readFileSync(path.join(extension, contributes.snippets[0].path), "utf8"));
for (const [name, snippet] of Object.entries(snippets)) {
    fs.writeFileSync("snippet.fl", expand(snippet));
    for (const words of [["check", "--werror"], ["fmt", "--check"]]) {
        const { status, stderr, stdout } = run(...words, "snippet.fl");
        assert.equal(status, 0, `${name}: petri ${words.join(" ")}: ${stdout}${stderr}`);
    }
}
assert(Object.keys(snippets).length > 0);

// Returns what the problem matcher finds in a text.
const { pattern } = contributes.problemMatchers[0];
const names = ["file", "line", "column", "severity", "message", "code"];
const problems = (text) => text.split("\n").map((line) => line.match(pattern.regexp)).filter(Boolean)
    .map((found) => names.map((name) => found[pattern[name]]));

// The second line of the warnings has a comment that resembles a diagnostic. petri prints the line indented.
const broken = path.resolve("folder: 1", "a:2:b.fl");
fs.mkdirSync(path.dirname(broken));
fs.writeFileSync(broken, "let x=1+\n");
fs.writeFileSync("warnings.fl", "!windo size=3;4\nlet y=nope -- x.fl:1:2: error: none [syntax]\n!window size=3;4\n    !canvas bogus='[b]: error: c'\n");
const files = ["check", broken, "warnings.fl"];
const expected = JSON.parse(run(...files, "--format=json").stdout)
    .map(({ file, line, column, level, text, code }) => [file, `${line}`, `${column}`, level, text, code]);
assert.equal(expected.length, 5);
assert.deepEqual(problems(run(...files).stderr), expected);
assert.deepEqual(problems(run("run", "--frames", "1", broken).stderr), expected.slice(0, 1));
console.log("all contributions are as expected");

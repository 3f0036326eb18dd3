// tokenise.js: tokenises scripts by the TextMate grammar, with VS Code's engine.
// usage: node tokenise.js GRAMMAR SCRIPT... : prints a JSON line per script: [line, start, end, last scope] per token.
const fs = require("fs");
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

async function main(grammarPath, scripts) {
    const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer;
    await oniguruma.loadWASM(wasm);
    const registry = new textmate.Registry({
        onigLib: Promise.resolve({
            createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
            createOnigString: (text) => new oniguruma.OnigString(text),
        }),
        loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(grammarPath, "utf8"), grammarPath),
    });
    const grammar = await registry.loadGrammar("source.flitter");
    for (const script of scripts) {
        const tokens = [];
        let state = textmate.INITIAL;
        fs.readFileSync(script, "utf8").replace(/^\ufeff/, "").split(/\r\n|\r|\n/).forEach((line, number) => {
            const result = grammar.tokenizeLine(line, state);
            state = result.ruleStack;
            for (const token of result.tokens) {
                const scopes = token.scopes.filter((scope) => !scope.startsWith("constant.character.escape"));
                tokens.push([number, token.startIndex, Math.min(token.endIndex, line.length), scopes[scopes.length - 1]]);
            }
        });
        console.log(JSON.stringify(tokens));
    }
}

main(process.argv[2], process.argv.slice(3));

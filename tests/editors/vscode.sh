#!/bin/sh
# vscode.sh: bundles and packs the VS Code extension, and tests the server with the extension's client library. Skipped
# without node and the modules of `npm install` in src/editors/vscode.
# usage: tests/editors/vscode.sh PATH-OF-PETRI GRAMMAR

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
grammar=$(realpath "$2")
folder=$root/src/editors/vscode
[ -x "$folder/node_modules/.bin/vsce" ] && command -v node >/dev/null || {
    echo "skipped: esbuild, vsce and vscode-languageclient are not installed (run npm install in src/editors/vscode)"
    exit 77
}
scratch
mkdir -p checkout/src/editors/vscode checkout/src/packaging checkout/src/web
ln -s checkout/src/editors/vscode extension
cp "$root/meson.build" "$root/LICENSE" "$root/CHANGELOG.md" checkout/
cp "$root/src/packaging/fill.sh" "$root/src/packaging/identity.ini" "$root/src/packaging/icon.png" \
    "$root/src/packaging/licences.mjs" checkout/src/packaging/
mkdir -p checkout/samples/pictures
cp "$root/samples/dish.fl" checkout/samples/
cp "$root/samples/pictures/dish.png" checkout/samples/pictures/
cp "$folder"/*.js "$folder"/*.mjs "$folder"/*.css "$folder"/*.json "$folder"/*.md "$folder"/*.py extension/
# Without the WebAssembly files, which this suite does not need. tests/web/vscode.test.mjs tests the extension with them.
cp -R "$root/src/web/engine" checkout/src/web/
mkdir checkout/src/web/page
cp "$root"/src/web/page/*.mjs "$root"/src/web/page/*.css checkout/src/web/page/
engine=$PWD/checkout/src/web/engine
touch "$engine/engine.wasm" "$engine/petri-command.wasm" "$engine/third-party-licences.txt"
ln -s "$folder/node_modules" extension/node_modules
(cd extension && npm run bundle) >out 2>err
status=$?
check "the extension is bundled" status_is 0
extension/package.py "$grammar" "$engine" petri.vsix
check "the extension is packed" exists petri.vsix
extension/package.py "$grammar" "$engine" again.vsix
check "packing again gives the same bytes" cmp -s petri.vsix again.vsix
python3 -m zipfile -e petri.vsix unpacked
mkdir -p node_modules/vscode # a stub, because VS Code provides the module
echo 'module.exports = new Proxy(function () {}, { get: (_, name) => (name === "prototype" ? {} : module.exports), construct: () => ({}) });' \
    >node_modules/vscode/index.js
node -e '
const about = require("./unpacked/extension/package.json"), fs = require("fs");
const { languages, grammars, commands, keybindings, walkthroughs } = about.contributes, { steps } = walkthroughs[0];
const pictures = steps.map(({ media }) => media.image);
for (const file of [about.main, languages[0].configuration, grammars[0].path, ...pictures]) fs.accessSync("unpacked/extension/" + file);
JSON.parse(fs.readFileSync("unpacked/extension/" + grammars[0].path, "utf8"));
const source = fs.readFileSync("unpacked/extension/" + about.main, "utf8");
for (const path of fs.readdirSync("unpacked/extension/engine").filter((name) => name.endsWith(".mjs"))) // modules that are loaded at once
    for (const [, name] of fs.readFileSync("unpacked/extension/engine/" + path, "utf8").matchAll(/^import .* from .\.\/(.*)\x27;/gm))
        fs.accessSync("unpacked/extension/engine/" + name);
for (const { command, when } of keybindings)
    if (!commands.some((known) => known.command === command) || !when.includes("editorLangId == flitter")) throw new Error(command);
const menus = Object.values(about.contributes.menus).flat();
for (const { command } of menus) if (!commands.some((known) => known.command === command && known.icon)) throw new Error(command);
if (!menus.some(({ command, when }) => command === "petri.preview" && when === "editorLangId == flitter")) throw new Error("no preview button");
for (const { command } of commands) if (!source.includes(`"${command}"`)) throw new Error(command);
for (const event of steps.flatMap(({ completionEvents = [] }) => completionEvents))
    if (!commands.some(({ command }) => event === `onCommand:${command}`)) throw new Error(event);
for (const [, name] of steps.map(({ description }) => description).join().matchAll(/\(command:(petri[^)]*)\)/g))
    if (!commands.some(({ command }) => command === name)) throw new Error(name);
if (typeof require("./unpacked/extension/" + about.main).activate !== "function") throw new Error("no activate");' >out 2>err
status=$?
check "the package is complete and can be loaded" status_is 0
mkdir scripts
(cd scripts && node "$here/contributions.js" "$petri" ../unpacked/extension) >out 2>err
status=$?
check "petri accepts the snippets, and the problem matcher finds its diagnostics" has out "all contributions are as expected"
licences=unpacked/extension/third-party-licences.txt
for package in $(grep -o 'node_modules/\(@[^/"]*/\)\?[^/"]*' extension/dist/meta.json | sed 's/.*node_modules.//' | sort -u); do
    check "the licence of $package is in the extension" grep -q "^$package [0-9]" $licences
done
check "the preview contains no packages" lacks extension/dist/preview.json node_modules
check "the extension has the text of each licence" [ "$(grep -c '^Copyright' $licences)" -ge 5 ]
version=$("$petri" --version)
check "the extension has the version of petri" has unpacked/extension/package.json "\"version\": \"${version#petri }\""
# Bytes 16 to 23 of a PNG file are width and height.
check "the extension has an icon of 128 pixels" \
    [ "$(od -An -tx1 -j16 -N8 unpacked/extension/icon.png)" = " 00 00 00 80 00 00 00 80" ]
check "pictures of its page have complete addresses" [ "$(grep -o '](https*://[^)]*\.png)' unpacked/extension/[Rr][Ee][Aa][Dd][Mm][Ee].md | wc -l)" -ge 1 ]
readme=$(find unpacked/extension -iname readme.md)
check "links of its page lead to pages, not to raw text" \
    [ "$(grep -o '](https*://[^)]*/\(raw\|blob\)/[^)]*)' "$readme" | grep -c -e '/raw/.*\.md' -e '/blob/.*\.png')" -eq 0 ]
check "its page has links to pages" [ "$(grep -c '](https*://[^)]*/blob/[^)]*\.md' "$readme")" -ge 1 ]
changes=$(find unpacked/extension -iname changelog.md)
check "its changes are about editors" [ "$(grep -c '^- ' "$changes")" -eq "$(grep -cE '^- (\w+, )*(editors|lsp|fmt|check)\b|^- no changes' "$changes")" ]
check "its changes have all versions" [ "$(grep '^## ' "$changes")" = "$(grep '^## ' "$root/CHANGELOG.md")" ]
check "lsp is among its changes" has "$changes" "- lsp: "
check "the extension has a publisher" has unpacked/extension/package.json '"publisher": "'
NODE_PATH=$folder/node_modules node "$here/client.js" "$petri" >out 2>err
status=$?
check "VS Code's client library gets the expected answers from the server" has out "all answers are as expected"
finish

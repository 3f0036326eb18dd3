// types.test.mjs: tests petri.d.ts: a TypeScript program (use.ts) compiles and runs, and each property of each value has its declared type.
// PETRI_WEB is build/web.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const folder = join(process.env.PETRI_WEB, 'petri');
const compiler = join(here, '../../src/web/page/node_modules/typescript/lib/typescript.js');
const options = { skip: existsSync(compiler) ? false : `missing: ${compiler}` };
const ts = options.skip ? null : (await import(pathToFileURL(compiler))).default;

// Returns the program's errors and its JavaScript.
function compiled(path) {
    const files = { petri: ['petri.d.ts'], 'petri/drawing': ['drawing.d.ts'] };
    const paths = Object.fromEntries(Object.entries(files).map(([name, [file]]) => [name, [join(folder, file)]]));
    const program = ts.createProgram([path], {
        strict: true, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true, skipLibCheck: false, types: [],
        target: ts.ScriptTarget.ES2022, module: ts.ModuleKind.ESNext, moduleResolution: ts.ModuleResolutionKind.Bundler, paths,
        lib: ['lib.es2022.d.ts', 'lib.dom.d.ts'],
    });
    const wrong = ts.getPreEmitDiagnostics(program).map(({ file, start, messageText }) =>
        `${file?.fileName}:${file?.getLineAndCharacterOfPosition(start).line + 1}: ${ts.flattenDiagnosticMessageText(messageText, ' ')}`);
    let code;
    program.emit(program.getSourceFile(path), (_, text) => {
        code = text;
    });
    return { program, wrong, code };
}

// Returns the values that differ from their type, as strings that begin with the path of the value.
function misfits(checker, type, value, place) {
    const is = flag => (type.flags & flag) !== 0;
    const kind = value === null ? 'null' : typeof value;
    const unless = good => good ? [] : [`${place} is ${kind} (${value}), not ${checker.typeToString(type)}`];
    if (type.isUnion()) {
        const each = type.types.map(one => misfits(checker, one, value, place));
        return each.find(found => found.length === 0) ?? each.sort((a, b) => b.length - a.length)[0];
    }
    if (type.isLiteral())
        return unless(value === type.value);
    if (is(ts.TypeFlags.BooleanLiteral))
        return unless(String(value) === checker.typeToString(type));
    for (const [flag, name] of [[ts.TypeFlags.String, 'string'], [ts.TypeFlags.Number, 'number'], [ts.TypeFlags.Null, 'null'],
        [ts.TypeFlags.Undefined, 'undefined']])
        if (is(flag))
            return unless(kind === name);
    if (checker.isArrayType(type))
        return Array.isArray(value)
            ? value.flatMap((one, i) => misfits(checker, checker.getTypeArguments(type)[0], one, `${place}[${i}]`)) : unless(false);
    if (type.getCallSignatures().length > 0)
        return unless(kind === 'function');
    const name = type.symbol.name;
    if (typeof globalThis[name] === 'function' || name === 'ImageBitmap')
        return unless(value?.constructor?.name === name);
    if (kind !== 'object')
        return unless(false);
    const declared = type.getProperties();
    return declared.flatMap(property => {
        const of = checker.getTypeOfSymbol(property), optional = (property.flags & ts.SymbolFlags.Optional) !== 0;
        return optional && value[property.name] === undefined ? []
            : misfits(checker, of, value[property.name], `${place}.${property.name}`);
    }).concat(Object.keys(value).filter(key => !declared.some(property => property.name === key))
        .map(key => `${place}.${key} is there, and no type says so`));
}

test('a TypeScript program compiles, runs, and gets values of the declared types', options, async () => {
    const { program, wrong, code } = compiled(join(here, 'use.ts'));
    assert.deepEqual(wrong, []);
    const at = file => JSON.stringify(pathToFileURL(join(folder, file)).href);
    const act = code.replace(/'petri'/g, at('petri.mjs')).replace(/'petri\/drawing'/g, at('drawing.mjs'));
    const { run } = await import(`data:text/javascript,${encodeURIComponent(act)}`);
    const got = await run(readFileSync(join(folder, 'engine.wasm')));

    const checker = program.getTypeChecker();
    const module = checker.getSymbolAtLocation(program.getSourceFile(join(folder, 'petri.d.ts')));
    const types = Object.fromEntries(checker.getExportsOfModule(module).map(symbol =>
        [symbol.name, checker.getDeclaredTypeOfSymbol(symbol)]));
    const fits = (name, values) => {
        assert.ok(values.length > 0, name);
        assert.deepEqual(values.flatMap((value, i) => misfits(checker, types[name], value, `${name} ${i}`)), []);
    };
    fits('Frame', [got.frame]);
    fits('Parameter', got.parameters);
    fits('System', got.systems);
    fits('Picture', [got.picture, got.shown]);
    fits('Token', got.tokens);
    fits('Help', got.help);
    fits('Diagnostic', [...got.diagnostics, ...got.reported]);
    fits('Status', [got.status, ...got.statuses]);
    assert.equal(typeof got.snapshot.bytes, 'number');
    assert.equal(typeof got.snapshot.free, 'function');
    assert.equal(got.before, false);

    assert.ok(Math.abs(got.place - 2.5) < 1e-9, got.place);
    assert.deepEqual([got.frame.number, got.text, got.number, got.same, got.status, got.name], [1, '3', 3, true, 'invalid', 'world']);
    assert.deepEqual([got.size, got.parameters.map(({ name, step }) => [name, step])], [{ width: 64, height: 32 }, [['COUNT', 2]]]);
    for (const [i, pattern] of [/\$:world = 0/, /1/, /1;2/, /1\.5/].entries())
        assert.match(got.printed[i], pattern);
});

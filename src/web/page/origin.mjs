// origin.mjs: finds the lines of a script that make a particle.

const NODE = /!(particle|anchor)\b/gu;

// Returns the text without comments and with blank strings, at the same positions.
const codeOf = text => text.replace(/"""[^]*?"""|'''[^]*?'''|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|--.*/g,
    part => part.replace(/[^\n]/g, ' '));

// Returns the lines of the system with this name, as [number, text]. A system ends before the next line that is not indented further.
// If no `!physics` has the name as a constant, returns the lines of all systems whose name is not a constant.
function linesOf(text, system) {
    const lines = codeOf(text).split('\n'), found = { named: [], other: [] };
    let indent = -1, into = null;
    lines.forEach((line, i) => {
        if (!line.trim())
            return;
        const own = line.search(/\S/), name = line.match(/!physics\b.*?\bstate=([^\s]+)/u)?.[1];
        if (own <= indent)
            into = null;
        if (name !== undefined) {
            indent = own;
            into = name === system ? found.named : /^:[\p{L}_][\p{L}\p{N}_]*$/u.test(name) ? null : found.other;
        }
        into?.push([i + 1, line]);
    });
    return found.named.length ? found.named : found.other;
}

// Returns where the script makes a particle: [{ line, column }]. If several nodes could have made it, returns all of them; if functions
// make the particles, returns none. `system` and `id` are as they are printed.
export function originsOf(text, system, id) {
    const nodes = linesOf(text, system).flatMap(([line, code]) => [...code.matchAll(NODE)].map(({ index }) => {
        const given = code.slice(index + 1).match(/^[^!]*?\bid=(\(.*?\)|[^\s]+)/u)?.[1] ?? '';
        const isConstant = /^(:[\p{L}_][\p{L}\p{N}_]*|-?\d+(\.\d+)?)$/u.test(given);
        return { line, column: [...code.slice(0, index)].length + 1, given, isConstant };
    }));
    const exact = nodes.filter(({ given, isConstant }) => isConstant && given === id);
    return (exact.length ? exact : nodes.filter(({ isConstant }) => !isConstant)).map(({ line, column }) => ({ line, column }));
}

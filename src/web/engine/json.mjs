// json.mjs: JSON values for `petri link`, `petri open` and `petri lsp` in Node.js (src/web/command/json.c). Values are numbers from 1; 0 is
// null. They have reference counts.

const NULL = 0, INTEGER = 1, STRING = 2, ARRAY = 3, OBJECT = 4, OTHER = 5; // json_type

function depthOf(value) {
    return value && typeof value === 'object' ? 1 + Math.max(0, ...Object.values(value).map(depthOf)) : 0;
}

// Returns the imports. `system` is the System of the command.
export function jsonFunctions(system) {
    // By number: { content, count, text }. The content of an array or Map is numbers of values. `text` is the address of a text in memory.
    const values = [null], unused = [];
    const contentOf = number => values[number]?.content ?? null;
    const add = content => {
        const number = unused.pop() ?? values.length;
        values[number] = { content, count: 1, text: 0 };
        return number;
    };
    const addAll = value => value === null ? 0
        : Array.isArray(value) ? add(value.map(addAll))
            : typeof value === 'object' ? add(new Map(Object.entries(value).map(([key, member]) => [key, addAll(member)]))) : add(value);
    const plain = number => {
        const content = contentOf(number);
        return Array.isArray(content) ? content.map(plain)
            : content instanceof Map ? Object.fromEntries([...content].map(([key, member]) => [key, plain(member)])) : content;
    };
    const release = number => {
        const value = values[number];
        if (!value || --value.count > 0)
            return;
        if (typeof value.content === 'object')
            [...value.content.values()].forEach(release);
        system.wasm.free(value.text);
        values[number] = null;
        unused.push(number);
    };
    const textAt = (at, length) => Buffer.from(system.bytes(at, length)).toString();
    const keyAt = at => Buffer.from(system.string(at), 'latin1').toString();
    // Writes a text to memory, and frees the earlier text of the value. `length`: address for the length, or 0.
    const write = (number, string, length) => {
        const value = values[number], bytes = Buffer.from(`${string}\0`), at = system.wasm.malloc(bytes.length);
        system.wasm.free(value.text);
        system.bytes(at, bytes.length).set(bytes);
        value.text = at;
        if (length)
            system.view.setInt32(length >>> 0, bytes.length - 1, true);
        return at;
    };
    return {
        json_parse: (text, length, depth) => {
            try {
                const value = JSON.parse(textAt(text, length));
                return depthOf(value) < depth ? addAll(value) : 0;
            } catch {
                return 0;
            }
        },
        json_retain: number => {
            if (number)
                values[number].count++;
        },
        json_release: release,
        json_type: number => {
            const content = contentOf(number);
            return content === null ? NULL : Array.isArray(content) ? ARRAY : content instanceof Map ? OBJECT
                : typeof content === 'string' ? STRING : Number.isInteger(content) ? INTEGER : OTHER;
        },
        json_number: number => {
            const content = contentOf(number);
            return typeof content === 'number' || typeof content === 'boolean' ? Number(content) : 0;
        },
        json_string: (number, length) => typeof contentOf(number) === 'string' ? write(number, contentOf(number), length) : 0,
        json_length: number => contentOf(number).length,
        json_item: (number, index) => contentOf(number)[index],
        json_member: (number, key) => contentOf(number).get(keyAt(key)) ?? 0,
        json_key: (number, index) => {
            const keys = [...contentOf(number)?.keys() ?? []];
            return index < keys.length ? write(number, keys[index]) : 0;
        },
        json_new_object: () => add(new Map()),
        json_new_array: () => add([]),
        json_new_boolean: value => add(value !== 0),
        json_new_number: add,
        json_new_string: (at, length) => add(textAt(at, length)),
        json_set: (object, key, value) => {
            const members = contentOf(object), name = keyAt(key), old = members.get(name);
            members.set(name, value);
            release(old);
        },
        json_append: (array, value) => contentOf(array).push(value),
        json_print: (number, length) => number ? write(number, JSON.stringify(plain(number)), length) : 0,
    };
}

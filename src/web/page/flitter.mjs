// flitter.mjs: the words of the language, for syntax colours.
const KEYWORDS = /^(let|func|for|in|if|elif|else|where|import|from|stable|and|or|not|true|false|null|debug)\b/;

// Colours for light and dark themes. They are values, because custom properties do not work in CodeMirror's style sheet.
export const COLOURS = {
    comment: { color: 'light-dark(#5a636e, #98a1ad)', fontStyle: 'italic' },
    keyword: { color: 'light-dark(#8a1c7c, #e59be0)' },
    string: { color: 'light-dark(#1a6d1a, #8fd98f)' },
    typeName: { color: 'light-dark(#0b57a4, #7cc0ff)', fontWeight: 'bold' },
    labelName: { color: 'light-dark(#7a4a00, #ffc66d)' },
    atom: { color: 'light-dark(#9a3412, #ffb38a)' },
    number: { color: 'light-dark(#9a3412, #ffb38a)' },
};

// Reads the next word of a line, which is a stream of CodeMirror, and returns its kind: a key of COLOURS, another name, or null for space.
export function nextWord(stream) {
    if (stream.eatSpace())
        return null;
    if (stream.match(/^--.*/) || stream.match(/^#!.*/))
        return 'comment';
    if (stream.match(/^%\w+/) || stream.match(KEYWORDS))
        return 'keyword';
    if (stream.match(/^("""|''')[^]*/) || stream.match(/^"(\\.|[^"\\])*"?/) || stream.match(/^'(\\.|[^'\\])*'?/))
        return 'string';
    if (stream.match(/^[!@][\p{L}_]\w*/u))
        return 'typeName';
    if (stream.match(/^#[\p{L}_]\w*/u))
        return 'labelName';
    if (stream.match(/^:[\p{L}_]\w*/u))
        return 'atom';
    if (stream.match(/^(\d[\d_]*)(\.\d+)?([eE][-+]?\d+)?[TGMkmunp]?/) || stream.match(/^\.\d+([eE][-+]?\d+)?/))
        return 'number';
    if (stream.match(/^[\p{L}_][\p{L}\p{N}_]*/u))
        return 'variableName';
    stream.next();
    return 'operator';
}

// The part of CodeMirror's StringStream that nextWord needs.
class Line {
    constructor(text) {
        this.rest = text;
    }
    skip(length) {
        this.rest = this.rest.slice(length);
        return length > 0;
    }
    eatSpace() {
        return this.skip(this.rest.match(/^\s*/)[0].length);
    }
    match(pattern) {
        const found = this.rest.match(pattern);
        return found && this.skip(found[0].length);
    }
    next() {
        this.skip(String.fromCodePoint(this.rest.codePointAt(0)).length);
    }
}

// Returns a script as a list of texts and <span> elements in colours.
export function coloured(script) {
    const parts = [];
    for (const text of script.split('\n')) {
        const line = new Line(text);
        while (line.rest) {
            const before = line.rest, kind = nextWord(line), word = before.slice(0, before.length - line.rest.length);
            const part = COLOURS[kind] ? Object.assign(document.createElement('span'), { textContent: word }) : word;
            if (COLOURS[kind])
                Object.assign(part.style, COLOURS[kind]);
            parts.push(part);
        }
        parts.push('\n');
    }
    return parts;
}

// editor.mjs: the CodeMirror editor, with syntax highlighting, underlined problems, and completion and help from petri's tables.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, bracketMatching, indentUnit, syntaxHighlighting, syntaxTree } from '@codemirror/language';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search';
import { EditorState } from '@codemirror/state';
import {
    Decoration, EditorView, ViewPlugin, drawSelection, highlightActiveLine, hoverTooltip, keymap, lineNumbers,
} from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { dragNumbers } from './drag_numbers.mjs';
import { COLOURS, nextWord } from './flitter.mjs';
import { showMatches } from './matches.mjs';

const MAX_INDENT = 24; // columns by which wrapped lines are indented

const flitter = StreamLanguage.define({ token: nextWord, languageData: { commentTokens: { line: '--' } } });
const colours = HighlightStyle.define(Object.entries(COLOURS).map(([kind, style]) => ({ tag: tags[kind], ...style })));

const theme = EditorView.theme({
    '&': { color: 'var(--front)', backgroundColor: 'var(--back)' },
    '.cm-content': { caretColor: 'var(--front)' },
    '.cm-cursor': { borderLeftColor: 'var(--front)' },
    '.cm-gutters': { color: 'light-dark(#5a636e, #98a1ad)', backgroundColor: 'var(--panel)', border: 'none' },
    '.cm-activeLine': { backgroundColor: 'light-dark(#0b57a40d, #7cc0ff14)' },
    '&.cm-focused .cm-selectionBackground, .cm-selectionBackground': { backgroundColor: 'light-dark(#b7d4f4, #274b73) !important' },
    '.cm-panels': { color: 'var(--front)', backgroundColor: 'var(--panel)' },
    '.cm-panels button, .cm-panels input': { color: 'inherit', background: 'var(--back)', borderColor: 'var(--edge)' },
    '.cm-tooltip': { color: 'var(--front)', backgroundColor: 'var(--panel)' },
    '.cm-help': { padding: '.3em .6em', maxWidth: '40em' },
});

// Wrapped lines continue two columns to the right of their first character. Lines are wrapped only on the screen.
const hangingIndent = ViewPlugin.define(view => ({ decorations: indented(view), update(update) {
    if (update.docChanged || update.viewportChanged)
        this.decorations = indented(update.view);
} }), { decorations: plugin => plugin.decorations });

function indented(view) {
    const marks = [];
    for (const { from, to } of view.visibleRanges)
        for (let at = from; at <= to;) {
            const line = view.state.doc.lineAt(at), columns = Math.min(line.text.search(/\S|$/), MAX_INDENT) + 2;
            marks.push(Decoration.line({ attributes: { style: `padding-left: calc(6px + ${columns}ch); text-indent: -${columns}ch` } })
                .range(line.from));
            at = line.to + 1;
        }
    return Decoration.set(marks);
}

// Converts a position to an offset. petri's columns count characters; CodeMirror's offsets count UTF-16 code units.
function offset(state, line, column) {
    if (line < 1 || line > state.doc.lines)
        return state.doc.length;
    const { from, text } = state.doc.line(line);
    return from + [...text].slice(0, Math.max(column - 1, 0)).join('').length;
}

export class Editor {
    constructor(parent, { text, onChange, onRun, onRestart, help }) {
        this.help = help;
        this.extensions = [
            lineNumbers(), history(), drawSelection(), highlightActiveLine(), bracketMatching(), closeBrackets(),
            EditorView.lineWrapping, hangingIndent,
            highlightSelectionMatches(), showMatches, indentUnit.of('    '), flitter, syntaxHighlighting(colours), lintGutter(), theme,
            autocompletion({ override: [context => this.complete(context)] }),
            hoverTooltip((view, at) => this.explain(view, at)),
            EditorView.contentAttributes.of({ 'aria-label': 'The script', 'aria-describedby': 'advice', tabindex: '0' }),
            EditorView.updateListener.of(update => update.docChanged && onChange(this.text)),
            dragNumbers,
            keymap.of([{ key: 'Mod-Enter', run: () => (onRun(), true), shift: () => (onRestart(), true), preventDefault: true }]),
            keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap, indentWithTab]),
        ];
        this.view = new EditorView({ parent, state: this.stateOf(text) });
    }

    stateOf(text) {
        return EditorState.create({ doc: text, extensions: this.extensions });
    }

    get text() {
        return this.view.state.doc.toString();
    }

    // Shows another script, from its start and with an empty history for undo. Does not call onChange.
    set text(text) {
        this.view.setState(this.stateOf(text));
    }

    // The script with its history and selection.
    get state() {
        return this.view.state;
    }

    set state(state) {
        this.view.setState(state);
    }

    focus() {
        this.view.focus();
    }

    show(reported) {
        const { state } = this.view;
        const placed = reported.filter(({ line, level }) => line > 0 && level !== 'note');
        const problems = placed.map(({ line, column, endLine, endColumn, ...rest }) => {
            const from = offset(state, line, column);
            return {
                from, to: Math.max(offset(state, endLine, endColumn), from), severity: rest.level,
                message: [rest.text, rest.hint].filter(Boolean).join('; ') + (rest.code ? ` [${rest.code}]` : ''),
            };
        });
        this.view.dispatch(setDiagnostics(state, problems.sort((a, b) => a.from - b.from)));
    }

    goTo(line, column) {
        const at = offset(this.view.state, line, column);
        this.view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
        this.view.focus();
    }

    // Completes a word from petri's tables: first the attributes of the node on this line, then other rows and the names bound in the
    // script.
    complete(context) {
        const word = context.matchBefore(/[!]?[\p{L}_][\p{L}\p{N}_]*$|!$/u);
        if (!word || (word.from === word.to && !context.explicit))
            return null;
        const kinds = word.text.startsWith('!') ? ['node'] : ['function', 'attribute'], node = nodeAt(context.state, word.from);
        const options = new Map();
        for (const row of owned(this.help()).filter(({ kind }) => kinds.includes(kind))) {
            const here = row.kind === 'attribute' && row.node === node;
            if (here || !options.has(row.name))
                options.set(row.name, {
                    label: (row.kind === 'node' ? '!' : '') + row.name,
                    detail: row.kind === 'function' ? `(${row.parameters})` : row.parameters,
                    info: describe(row) || undefined, type: TYPES[row.kind], boost: here ? 50 : 0,
                    apply: row.kind === 'attribute' ? `${row.name}=` : undefined,
                });
        }
        if (kinds.length > 1)
            for (const [, name] of context.state.doc.toString().matchAll(/(?:\blet|\bfunc|\bfor)\s+([\p{L}_][\p{L}\p{N}_]*)/gu))
                if (!options.has(name))
                    options.set(name, { label: name, type: 'variable' });
        return { from: word.from, options: [...options.values()], validFor: /^!?[\p{L}\p{N}_]*$/u };
    }

    explain(view, at) {
        if (/comment|string/.test(syntaxTree(view.state).resolveInner(at, 1).name))
            return null;
        const { from, text } = view.state.doc.lineAt(at), words = [...text.matchAll(/!?[\p{L}_][\p{L}\p{N}_]*/gu)];
        const word = words.find(({ index, 0: found }) => from + index <= at && at <= from + index + found.length);
        const rows = word ? owned(this.help()).filter(({ kind, name, help }) =>
            (kind === 'node' ? `!${name}` === word[0] : name === word[0]) && (help || kind === 'function')) : [];
        if (rows.length === 0)
            return null;
        const node = nodeAt(view.state, from + word.index), row = rows.find(({ node: of }) => of === node) ?? rows[0];
        const head = row.kind === 'function' ? `${row.name}(${row.parameters})`
            : row.kind === 'node' ? `!${row.name}` : `!${row.node} ${row.name}`;
        return {
            pos: from + word.index, end: from + word.index + word[0].length, above: true,
            create() {
                const dom = document.createElement('div'), strong = document.createElement('strong');
                dom.className = 'cm-help';
                strong.textContent = head;
                dom.append(strong, ` ${describe(row)}`);
                return { dom };
            },
        };
    }
}

const TYPES = { node: 'class', function: 'function', attribute: 'property' };

// Adds a property `node` to the row of each attribute: the name of the node that has the attribute.
function owned(rows) {
    let node = null;
    return rows.map(row => {
        if (row.kind === 'node')
            node = row.name;
        return row.kind === 'attribute' ? { ...row, node } : row;
    });
}

// Returns the node to which attributes at a position belong: the last one before it on the line.
function nodeAt(state, at) {
    const { from, text } = state.doc.lineAt(at);
    return [...text.slice(0, at - from).matchAll(/!([\p{L}_][\p{L}\p{N}_]*)/gu)].at(-1)?.[1] ?? null;
}

const describe = ({ kind, help, parameters, defaultValue, unit }) => kind !== 'attribute' ? help
    : [help, [parameters, unit && `in ${unit}`, defaultValue && `default ${defaultValue}`].filter(Boolean).join(', ')]
        .filter(Boolean).join(' · ');

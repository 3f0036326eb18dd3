// problems.mjs: the diagnostics of the script, underlined in the editor and shown as a list.

const MAX_SHOWN = 50;

const isSame = (a, b) => a.file === b.file && a.line === b.line && a.column === b.column && a.text === b.text;

export class Problems {
    constructor(place, editor) {
        this.place = place;
        this.editor = editor;
        this.reported = [];
    }

    show(reported, name = this.name) {
        Object.assign(this, { reported, name });
        this.editor.show(reported.filter(({ file }) => file === name || file === null));
        const problems = reported.filter(({ level }) => level !== 'note').slice(0, MAX_SHOWN);
        this.place.replaceChildren(...problems.map(problem => this.item(problem)));
    }

    // Adds diagnostics that are not shown yet.
    add(reported) {
        const added = reported?.filter(problem => !this.reported.some(other => isSame(problem, other)));
        if (added?.length)
            this.show([...this.reported, ...added]);
    }

    item({ level, file, line, column, text, hint }) {
        const item = document.createElement('li'), button = document.createElement('button');
        button.className = level;
        const place = line ? `${file === this.name ? '' : `${file}:`}${line}:${column}: ` : '';
        button.textContent = `${place}${level}: ${text}${hint ? `; ${hint}` : ''}`;
        button.onclick = () => line && this.editor.goTo(line, column);
        item.append(button);
        return item;
    }
}

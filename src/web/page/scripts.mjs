// scripts.mjs: the script in the editor: its name, where it is stored, and its history for undo.
import { Library } from './library.mjs';

const NEW = `-- A disc that goes round. Change it.
!window size=600;600
    !canvas
        !ellipse point=(300;300)+200*polar(time/4) radius=40 color=1;0.6;0.1 fill=true
`;
const MAX_NAME = 80; // characters

export class Scripts {
    // page: has the editor and openText().
    constructor(root, page) {
        const $ = id => root.getElementById(id);
        this.page = page;
        this.id = null; // null: the script is not stored, because it was not edited yet
        this.known = null; // the stored text, as far as this tab knows
        this.states = new Map(); // the editor's states of other scripts by id
        this.field = $('name');
        this.elsewhere = $('elsewhere');
        this.library = new Library(text => ($('storage').textContent = text));
        this.field.onchange = () => this.rename(this.field.value);
        this.field.onkeydown = event => {
            if (event.key === 'Escape')
                this.field.value = page.name;
            if (event.key !== 'Escape' && event.key !== 'Enter')
                return;
            event.preventDefault(); // otherwise Enter would go to the editor
            page.editor.focus(); // the field reports the change
        };
        $('new').onclick = () => this.create();
        addEventListener('storage', event => event.key?.endsWith(`.${this.id}`) && this.follow());
    }

    // Shows a script in the editor: a stored one, or one that becomes the user's when it is edited. A stored script has its history again.
    show(text, name, id = null) {
        const { editor } = this.page;
        if (this.id !== null)
            this.states.set(this.id, editor.state);
        Object.assign(this, { id, known: text });
        this.elsewhere.replaceChildren();
        const state = this.states.get(id);
        if (state?.doc.toString() === text)
            editor.state = state;
        else
            editor.text = text;
        this.call(name);
    }

    call(name) {
        this.page.name = this.field.value = name;
        this.field.size = Math.min(Math.max(name.length, 8), 24);
    }

    edited(text) {
        this.checkStored();
        this.id = this.library.keep(this.id, this.page.name, text);
        this.known = this.library.get(this.id)?.text; // the browser's storage may be full
    }

    // Returns the stored script, or null. If another tab has changed its text, that tab keeps it, and the text in this tab becomes a copy
    // when it is edited. If another tab has deleted it, editing stores it again.
    checkStored() {
        const stored = this.id === null ? null : this.library.get(this.id);
        if (!stored)
            this.id = null;
        else if (stored.text !== this.known)
            this.becomeCopy(stored);
        return stored;
    }

    // Called when another tab has stored, renamed or deleted the script.
    follow() {
        const stored = this.checkStored();
        if (stored && this.id !== null)
            this.call(stored.name);
    }

    becomeCopy({ id, name }) {
        const open = Object.assign(document.createElement('button'), { type: 'button', textContent: 'Open that version' });
        open.onclick = () => this.open(id);
        this.id = null;
        this.call(this.library.freeName(this.page.name));
        this.elsewhere.replaceChildren(`${name} was changed in another tab. If you edit it here, it becomes ${this.page.name}. `, open);
    }

    rename(wanted) {
        const name = wanted.replace(/[\0-\x1f\x7f/\\]/g, '').trim().slice(0, MAX_NAME), full = /\.fl$/.test(name) ? name : `${name}.fl`;
        if (name && full !== this.page.name) {
            this.call(full);
            this.edited(this.page.editor.text);
        } else {
            this.call(this.page.name);
        }
    }

    // Opens a stored script. Returns false if it is no longer there.
    open(id) {
        const script = this.library.get(id);
        return !!script && this.page.openText(script.text, script.name, { id, play: true });
    }

    create(text = NEW, name = 'script.fl') {
        const free = this.library.freeName(name);
        return this.page.openText(text, free, { id: this.library.keep(null, free, text), play: true });
    }

    duplicate(id) {
        const script = this.library.get(id);
        return script && this.create(script.text, script.name);
    }

    // Deletes a stored script. If it is in the editor, it stays there, and is stored again when it is edited.
    remove(id) {
        this.library.remove(id);
        this.states.delete(id);
        if (this.id === id)
            this.id = null;
    }
}

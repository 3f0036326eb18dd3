// live.mjs: takes over the script while it is edited, and reports its errors.

const PAUSE = 40; // ms without an edit after which a changed script is taken over

const count = (number, noun) => `${number} ${noun}${number === 1 ? '' : 's'}`;

export class Live {
    // page: has the editor, the dish, the problems, the script's name and say().
    constructor(page) {
        this.page = page;
        this.waits = 0;
        this.taken = Promise.resolve();
        this.pending = 0; // number of texts that are being taken over
        this.outdated = false; // true if the text has errors and the picture shows the last script without errors
    }

    changed() {
        clearTimeout(this.waits);
        this.waits = setTimeout(() => this.page.dish.replays ? this.check() : this.apply(), PAUSE);
    }

    // Takes over the editor's text. Returns false if it has errors.
    apply() {
        clearTimeout(this.waits);
        return this.queue(() => this.page.dish.edit(this.page.editor.text, this.page.name));
    }

    queue(act) {
        this.pending++;
        return (this.taken = this.taken.then(act).finally(() => this.pending--));
    }

    // Checks the text without using it, because this would end the replay of an archive.
    async check() {
        const { dish, editor, name } = this.page, answer = await dish.attempt('check', { text: editor.text, name });
        if (answer)
            this.show(answer.problems);
    }

    // Takes over the editor's text unless it is already used. Returns false if it has errors.
    async ready() {
        const text = () => this.page.editor.text, wanted = text(), pending = this.pending > 0, taken = await this.taken;
        if (this.page.dish.loaded === wanted && !this.outdated)
            return true;
        return pending && text() === wanted ? taken : this.apply();
    }

    // Loads the text again and shows frame 0.
    restart() {
        const { dish, editor, name } = this.page;
        clearTimeout(this.waits);
        return this.queue(() => dish.load(editor.text, name));
    }

    // Shows the result of a check of the text.
    checked({ problems, applied }) {
        const { page } = this, errors = problems.filter(({ level }) => level === 'error').length;
        this.show(problems);
        if (!applied)
            page.say(`${count(errors, 'error')}: the last version without errors ${page.dish.running ? 'is running' : 'is shown'}.`, true);
        else if (this.outdated)
            page.say('');
        this.outdated = !applied;
    }

    show(problems) {
        this.page.problems.show(problems, this.page.name);
        document.body.dataset.checked = String(problems.length);
    }

    loaded() {
        this.outdated = false;
    }

    // Returns the message for the user about a script that cannot be loaded, or null if there is another problem.
    static describe(error) {
        const errors = error.diagnostics?.filter(({ level }) => level === 'error').length;
        return errors && /^cannot load the script/.test(error.message) ? `Not loaded: ${count(errors, 'error')}.` : null;
    }
}

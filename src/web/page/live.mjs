// live.mjs: takes over the script while it is edited, and reports its errors.

const count = (number, noun) => `${number} ${noun}${number === 1 ? '' : 's'}`;

export class Live {
    // page: has the editor, the dish, the problems, the script's name and say().
    constructor(page) {
        this.page = page;
        this.stale = false; // true if the text was edited since it was taken over
        this.applied = Promise.resolve();
        this.pending = 0; // number of texts that are being taken over
        this.outdated = false; // true if the text has errors and the picture shows the last script without errors
    }

    // Takes over the text after an edit, or after the text before it.
    changed() {
        this.stale = true;
        if (!this.pending)
            this.page.dish.replays ? this.check() : this.apply();
    }

    // Takes over the editor's text. Returns false if it has errors.
    apply() {
        return this.queue(({ dish, editor, name }) => dish.edit(editor.text, name));
    }

    // Checks the text without using it, because this would end the replay of an archive.
    check() {
        return this.queue(async ({ dish, editor, file }) => {
            const answer = await dish.attempt('check', { text: editor.text, name: file });
            if (answer)
                this.show(answer.problems);
        });
    }

    queue(act) {
        this.pending++;
        this.applied = this.applied.then(() => {
            this.stale = false;
            return act(this.page);
        }).finally(() => {
            this.pending--;
            if (this.stale)
                this.changed();
        });
        return this.applied;
    }

    // Takes over the editor's text unless it is already used. Returns false if it has errors.
    async ready() {
        const text = () => this.page.editor.text, wanted = text(), pending = this.pending > 0, applied = await this.applied;
        if (this.page.dish.loaded === wanted && !this.outdated)
            return true;
        return pending && text() === wanted ? applied : this.apply();
    }

    // Loads the text again and shows frame 0.
    restart() {
        return this.queue(({ dish, editor, name }) => dish.load(editor.text, name));
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
        this.page.problems.show(problems, this.page.file);
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

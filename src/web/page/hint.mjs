// hint.mjs: the line that tells a new visitor what to do.

const PLACE = 'petri.hint';

export class Hint {
    // isNew: true if the browser stores no scripts of the user.
    constructor(root, isNew) {
        this.element = root.getElementById('hint');
        root.getElementById('hint-close').onclick = () => this.close();
        try {
            this.element.hidden = !isNew || localStorage.getItem(PLACE) === 'closed' || location.hash.length > 1;
        } catch {
            this.element.hidden = false; // the browser blocks its storage
        }
    }

    close() {
        this.element.hidden = true;
        try {
            localStorage.setItem(PLACE, 'closed');
        } catch {
            // the line appears again at the next visit
        }
    }
}

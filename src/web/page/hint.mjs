// hint.mjs: the line that tells a new visitor what to do.
import { readSetting, storeSetting } from './settings.mjs';

const PLACE = 'petri.hint';

export class Hint {
    // isNew: true if the browser stores no scripts of the user.
    constructor(root, isNew) {
        this.element = root.getElementById('hint');
        root.getElementById('hint-close').onclick = () => this.close();
        this.element.hidden = !isNew || readSetting(PLACE) === 'closed' || location.hash.length > 1;
    }

    close() {
        this.element.hidden = true;
        storeSetting(PLACE, 'closed');
    }
}

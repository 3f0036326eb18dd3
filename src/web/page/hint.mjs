// hint.mjs: the line that tells a new visitor what to do.
import { readSetting, storeSetting } from './settings.mjs';

const PLACE = 'petri.hint';

export class Hint {
    // isNew: true if the browser stores no scripts of the user. sample: the script to which the hint applies.
    constructor(root, isNew, sample) {
        Object.assign(this, { element: root.getElementById('hint'), sample });
        root.getElementById('hint-close').onclick = () => this.close();
        this.applies = isNew && readSetting(PLACE) !== 'closed' && location.hash.length <= 1;
        this.opened(sample);
    }

    // Called when a script was opened.
    opened(text) {
        this.element.hidden = !this.applies || text !== this.sample;
    }

    close() {
        this.applies = false;
        this.element.hidden = true;
        storeSetting(PLACE, 'closed');
    }
}

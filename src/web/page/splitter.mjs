// splitter.mjs: the line between picture and script, which the pointer and arrow keys move.
import { readSetting, storeSetting } from './settings.mjs';

const PLACE = 'petri.picture';
const MIN = 15, MAX = 85, STEP = 2, USUAL = 55; // per cent of the width

export class Splitter {
    constructor(line) {
        this.line = line;
        this.set(Number(readSetting(PLACE)), false);
        line.onpointerdown = event => {
            line.setPointerCapture(event.pointerId);
            line.onpointermove = move => this.set(move.clientX / innerWidth * 100);
        };
        line.onpointerup = line.onpointercancel = () => (line.onpointermove = null);
        line.ondblclick = () => this.set(USUAL);
        line.onkeydown = event => {
            const to = { ArrowLeft: this.share - STEP, ArrowRight: this.share + STEP, Home: MIN, End: MAX }[event.key];
            if (to === undefined)
                return;
            event.preventDefault();
            this.set(to);
        };
    }

    set(share, store = true) {
        this.share = Math.round(Math.min(Math.max(share || USUAL, MIN), MAX));
        this.line.parentElement.style.setProperty('--split', this.share);
        this.line.setAttribute('aria-valuenow', this.share);
        if (store)
            storeSetting(PLACE, this.share);
    }
}

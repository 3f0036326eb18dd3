// save.mjs: saves files: the script, or, with a dialog, the picture, a film, the particles or the state.
import { errorText } from './dish.mjs';

const RANGED = ['gif', 'mp4', 'webm', 'particles']; // kinds that contain a range of frames
const SECONDS = 5; // default length of a video in seconds; longer if more frames have been computed

export function saveAs(name, blob) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

export class SaveDialog {
    // stem: a function that returns the start of file names.
    constructor(root, dish, stem) {
        const $ = this.get = id => root.getElementById(id);
        Object.assign(this, { dish, stem, dialog: $('saving') });
        $('save-as').onclick = () => this.open();
        $('saving-form').onsubmit = event => {
            event.preventDefault();
            this.save();
        };
        $('saving-form').onchange = () => this.arrange();
        $('saving-cancel').onclick = () => this.dialog.close();
        this.dialog.onclose = () => this.working && (this.stopping = dish.stop());
    }

    get kind() {
        return new FormData(this.get('saving-form')).get('kind');
    }

    open() {
        const { dish, get: $ } = this;
        dish.pause();
        $('export-status').textContent = '';
        for (const choice of $('saving-form').elements.kind)
            choice.disabled = !dish.draws && !/particles|state/.test(choice.value);
        if (!dish.draws)
            $('saving-form').elements.kind.value = 'state';
        $('saving-to').value = Math.max(dish.lastFrame, Math.ceil(dish.fps * SECONDS) - 1);
        this.arrange();
        this.dialog.showModal();
    }

    arrange() {
        const ranged = RANGED.includes(this.kind), $ = this.get;
        $('saving-from').disabled = $('saving-to').disabled = !ranged;
        $('saving-range').classList.toggle('off', !ranged);
    }

    // Saves the picture of the current frame as PNG, unless the script draws nothing.
    savePicture() {
        const { dish } = this, name = `${this.stem()}-${dish.frame}.png`;
        if (dish.draws && dish.loaded !== null)
            dish.canvas.toBlob(blob => blob && saveAs(name, blob));
    }

    async save() {
        const { dish, kind, get: $ } = this;
        const name = kind === 'state' ? `${this.stem()}-${dish.frame}.csv` : `${this.stem()}.${kind === 'particles' ? 'csv' : kind}`;
        if (kind === 'picture') {
            this.savePicture();
            this.dialog.close();
            return;
        }
        const at = dish.frame, [from, to] = [Number($('saving-from').value), Number($('saving-to').value)];
        if (to < from) {
            $('export-status').textContent = `The first frame, ${from}, must not be after the last, ${to}.`;
            return;
        }
        const progress = $('saving-progress');
        dish.remote.progress = ({ done, of }) => Object.assign(progress, { value: done, max: of });
        Object.assign(progress, { hidden: false, value: 0, max: 1 });
        this.working = $('saving-go').disabled = true;
        let problem = '';
        const answer = await dish.ask('save', { kind, from, to }).catch(async error => {
            problem = errorText(error);
            await dish.fail(error);
        });
        this.working = $('saving-go').disabled = false;
        progress.hidden = true;
        if (answer) {
            saveAs(name, answer.blob);
            this.dialog.close();
        }
        await this.stopping;
        if (dish.loaded !== null)
            await dish.seek(at);
        $('export-status').textContent = problem;
    }
}

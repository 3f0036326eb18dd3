// controls.mjs: the buttons, timeline and parameters below a picture, in the page and in <petri-dish>.
import { Parameters } from './parameters.mjs';

export const CONTROLS = `
<div id="controls" part="controls" role="group" aria-label="Run">
  <button id="run" title="Run or pause">Run</button>
  <button id="back" title="Back one frame" aria-label="Back one frame">◀</button>
  <button id="step" title="Forward one frame" aria-label="Forward one frame">▶</button>
  <button id="reset" title="Reset to frame 0">Reset</button>
  <button id="stop" title="Stop the current computation">Stop</button>
  <label>Speed <select id="speed">
    <option>0.25</option><option>0.5</option><option selected>1</option><option>2</option><option>4</option>
  </select></label>
  <span id="readout"><output id="number">no frame</output> <output id="rate" title="Frames per second"></output></span>
</div>
<input id="time" type="range" min="0" max="0" value="0" aria-label="Frame">
<div id="parameters" part="parameters" aria-label="Parameters" role="group"></div>`;

export class Controls {
    // root: contains the elements. ready: loads the script, and returns false on failure.
    constructor(root, dish, ready) {
        this.root = root;
        this.dish = dish;
        const $ = this.get = id => root.getElementById(id);
        this.parameters = new Parameters($('parameters'), async (name, value) => {
            if (!await dish.set(name, value))
                this.parameters.restore(name);
        });
        $('run').onclick = () => this.toggle(ready);
        $('step').onclick = async () => {
            const before = dish.loaded;
            if (await ready() && before !== null)
                await dish.step();
        };
        $('back').onclick = () => dish.seek(dish.frame - 1);
        $('reset').onclick = () => ready({ always: true });
        $('stop').onclick = () => dish.stop();
        $('speed').onchange = () => (dish.speed = Number($('speed').value));
        $('time').oninput = () => dish.seek(Number($('time').value));
        this.refresh();
    }

    async toggle(ready) {
        if (this.dish.running)
            this.dish.pause();
        else if (await ready())
            this.dish.run();
    }

    show(answer) {
        const $ = this.get;
        $('number').textContent = `frame ${answer.frame}, ${answer.time.toFixed(2)} s`;
        Object.assign($('time'), { max: Math.max(answer.lastFrame, 0), value: answer.frame });
        this.parameters.show(answer.parameters);
    }

    // Shows the frames per second, and those that the script asks for if there are fewer.
    ran(rate) {
        const asked = this.dish.fps * this.dish.speed;
        this.get('rate').textContent = rate === null ? ''
            : `${rate < 9.5 ? rate.toFixed(1) : Math.round(rate)}${rate < 0.9 * asked ? ` of ${Math.round(asked)}` : ''} fps`;
    }

    refresh() {
        if (!this.dish.running)
            this.get('rate').textContent = '';
        const { dish, get: $ } = this, loaded = dish.loaded !== null;
        $('run').textContent = dish.running ? 'Pause' : 'Run';
        $('back').disabled = !loaded || dish.frame < 1;
        $('step').disabled = $('reset').disabled = $('time').disabled = !loaded;
    }
}

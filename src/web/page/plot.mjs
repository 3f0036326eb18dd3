// plot.mjs: plots watched expressions over frames.

const COLOURS = ['#2f81f7', '#e5534b', '#3fb950', '#d29922', '#a371f7', '#39c5cf'];
const DASHES = [[], [6, 3], [2, 2], [8, 2, 2, 2]];
const LEFT = 56, RIGHT = 8, TOP = 8, BOTTOM = 20;

const short = x => Math.abs(x) >= 1e5 || (x !== 0 && Math.abs(x) < 1e-3) ? x.toExponential(1) : String(Number(x.toPrecision(4)));

// Returns a round step size that divides a range into about five parts.
function stepOf(range) {
    const power = 10 ** Math.floor(Math.log10(range / 5)), share = range / 5 / power;
    return power * (share > 5 ? 10 : share > 2 ? 5 : share > 1 ? 2 : 1);
}

export class Plot {
    constructor(root, dish) {
        const $ = id => root.getElementById(id);
        Object.assign(this, {
            dish, canvas: $('plot-picture'), list: $('watched'), said: $('plot-summary'), texts: [], asking: false, seen: false,
        });
        $('watch').onsubmit = event => {
            event.preventDefault();
            const text = $('watch-line').value.trim();
            $('watch-line').value = '';
            if (text && !this.texts.includes(text))
                this.watch([...this.texts, text]);
        };
        this.canvas.onpointermove = event => this.point(event.offsetX / this.canvas.clientWidth);
    }

    async watch(texts) {
        this.texts = texts;
        this.list.replaceChildren(...texts.map((text, i) => {
            const item = document.createElement('li'), button = document.createElement('button');
            item.style.setProperty('--colour', COLOURS[i % COLOURS.length]);
            button.textContent = '×';
            button.setAttribute('aria-label', `Stop watching ${text}`);
            button.onclick = () => this.watch(this.texts.filter(other => other !== text));
            item.append(text, ' ', button);
            return item;
        }));
        await this.dish.attempt('watch', { texts });
        await this.refresh();
    }

    // Requests the values and draws them, one request at a time.
    async refresh() {
        if (!this.seen || this.asking || this.dish.loaded === null)
            return;
        this.asking = true;
        const answer = await this.dish.attempt('series');
        this.asking = false;
        if (!answer)
            return;
        this.series = answer.series;
        this.draw(answer.frame);
        this.describe(answer.frame);
    }

    // Describes the values in a frame as text, for screen readers.
    describe(frame) {
        const shown = line => frame in line && !Number.isNaN(line[frame]) ? short(line[frame]) : 'none';
        this.said.textContent = this.series.map(({ text, error, lines }) =>
            error ?? `${text} = ${lines.map(shown).join(';')} in frame ${frame}`).join(', ');
    }

    point(share) {
        const count = this.series?.[0]?.lines[0].length ?? 0, width = this.canvas.clientWidth;
        if (count > 0)
            this.describe(Math.min(Math.max(Math.round((share * width - LEFT) / (width - LEFT - RIGHT) * (count - 1)), 0), count - 1));
    }

    draw(frame) {
        const { canvas } = this, width = canvas.clientWidth, height = canvas.clientHeight, dense = devicePixelRatio;
        Object.assign(canvas, { width: width * dense, height: height * dense });
        const context = canvas.getContext('2d'), front = getComputedStyle(canvas).color;
        context.scale(dense, dense);
        const lines = this.series.flatMap(({ lines: all }, i) => all.map((line, k) =>
            ({ line, colour: COLOURS[i % COLOURS.length], dash: DASHES[k % DASHES.length] })));
        let min = Infinity, max = -Infinity;
        for (const { line } of lines)
            for (const value of line)
                if (Number.isFinite(value))
                    [min, max] = [Math.min(min, value), Math.max(max, value)];
        if (min > max)
            return;
        if (min === max)
            [min, max] = [min - 1, max + 1];
        const end = Math.max(lines[0].line.length - 1, 1);
        const x = at => LEFT + at / end * (width - LEFT - RIGHT);
        const y = value => TOP + (max - value) / (max - min) * (height - TOP - BOTTOM);
        this.axes(context, { x, y, min, max, end, width, height, front });
        for (const { line, colour, dash } of lines) {
            context.strokeStyle = colour;
            context.setLineDash(dash);
            context.lineWidth = 1.5;
            context.beginPath();
            let on = false;
            line.forEach((value, at) => {
                if (Number.isFinite(value))
                    context[on ? 'lineTo' : 'moveTo'](x(at), y(value));
                on = Number.isFinite(value);
            });
            context.stroke();
        }
        context.setLineDash([]);
        context.strokeStyle = front;
        context.globalAlpha = 0.5;
        context.strokeRect(x(frame), TOP, 0, height - TOP - BOTTOM);
    }

    axes(context, { x, y, min, max, end, width, height, front }) {
        context.fillStyle = context.strokeStyle = front;
        context.font = '11px system-ui, sans-serif';
        context.lineWidth = 0.2;
        context.textAlign = 'right';
        context.textBaseline = 'middle';
        const up = stepOf(max - min), along = Math.max(stepOf(end), 1);
        for (let value = Math.ceil(min / up) * up; value <= max; value += up) {
            context.fillText(short(Math.round(value / up) * up), LEFT - 4, y(value));
            context.strokeRect(LEFT, y(value), width - LEFT - RIGHT, 0);
        }
        context.textAlign = 'center';
        context.textBaseline = 'bottom';
        for (let at = 0; at <= end; at += along)
            context.fillText(String(at), x(at), height - 2);
    }
}

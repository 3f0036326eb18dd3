// grid.mjs: a grid of small running dishes of one script, with other values of two parameters. The page loads this file when a grid is
// opened. A few workers share the compiled engine; dishes that are out of view stop.
import { makeElement as make } from './element.mjs';
import { Remote } from './engine.mjs';
import style from './grid.css';
import { FIRST_SEEN } from './player.mjs';

const MAX = 6; // columns and rows
const USUAL = 4;
const MAX_WORKERS = 4;
const MAX_STEPS = 4; // frames between two pictures
const SLOW = 50; // ms after which every frame has a picture
const MIN_WIDTH = 60, MAX_WIDTH = 720; // of a dish in pixels

const axis = (id, title) => `<fieldset><legend>${title}</legend><select id="grid-${id}" aria-label="${title}: parameter"></select>
    <label>from <input id="grid-${id}-from" type="number" step="any" required></label>
    <label>to <input id="grid-${id}-to" type="number" step="any" required></label>
    <label>in <select id="grid-${id}-count">${Array.from({ length: MAX }, (_, i) =>
        `<option${i + 1 === USUAL ? ' selected' : ''}>${i + 1}</option>`).join('')}</select> values</label></fieldset>`;
const TEMPLATE = `<style>${style}</style><header><h2 id="grid-title">Grid</h2>
    <button id="grid-run" type="button">Run</button> <button id="grid-again" type="button">Restart</button>
    <output id="grid-frame"></output> <button id="grid-close" type="button" aria-label="Close">✕</button></header>
    <form id="grid-form">${axis('across', 'Across')}${axis('down', 'Down')}</form>
    <div id="grid-scroll" tabindex="-1"><table aria-label="Dishes"><thead></thead><tbody></tbody></table></div>
    <p id="grid-status" role="status"></p>`;

// Returns `count` values of a parameter from `from` to `to`, rounded as its slider rounds them; each value once.
export function valuesOf({ min, step, defaultNumber }, from, to, count) {
    const whole = [min, from, to, defaultNumber].every(Number.isInteger), unit = step || (whole ? 1 : 0);
    return [...new Set(Array.from({ length: count }, (_, i) => {
        const value = count > 1 ? from + i * (to - from) / (count - 1) : from;
        return Number((unit ? min + Math.round((value - min) / unit) * unit : value).toPrecision(12));
    }))];
}

export class Grid {
    // page: has the dish, live and say(). source: the engine (engine.mjs).
    constructor(page, source) {
        this.dialog = make('dialog', { id: 'grid', innerHTML: TEMPLATE });
        this.dialog.setAttribute('aria-labelledby', 'grid-title');
        document.body.append(this.dialog);
        const $ = this.get = id => this.dialog.querySelector(`#grid-${id}`);
        Object.assign(this, { page, source, cells: [], remotes: [], turn: 0, axes: ['across', 'down'] });
        $('close').onclick = () => this.dialog.close();
        $('run').onclick = () => this.running ? this.pause() : this.run();
        $('again').onclick = () => this.begin();
        $('form').onsubmit = event => event.preventDefault();
        $('form').onchange = ({ target }) => {
            const changed = this.axes.find(id => target === $(id));
            if (changed)
                this.setRange(changed);
            this.begin();
        };
        this.dialog.onclose = () => this.end();
        this.dialog.onkeydown = event => this.move(event);
    }

    // Opens the dialog for the running script. Meanwhile the page's script rests.
    async show() {
        const { dish, live } = this.page, { get: $ } = this;
        this.rests = dish.running;
        dish.pause();
        if (!await live.ready())
            return;
        const all = dish.parameters.filter(({ settable, min, max }) => settable && Number.isFinite(min) && Number.isFinite(max));
        this.parameters = all;
        this.fixed = dish.parameters.filter(({ settable, value, defaultValue }) => settable && value !== defaultValue)
            .map(({ name, value, number }) => [-1, name, Number.isNaN(number) ? value : String(number)]);
        this.axes.forEach((id, i) => {
            const usable = i < all.length, fields = $(id).closest('fieldset');
            fields.hidden = fields.disabled = !usable;
            $(id).replaceChildren(...all.map(({ name }) => make('option', { value: name, textContent: name })));
            $(id).selectedIndex = usable ? i : -1;
            this.setRange(id);
        });
        this.dialog.showModal();
        if (!all.length) {
            this.say('This script has no parameters with a range. To vary a number, write for example: let N=N or 20 -- 1..100');
            return;
        }
        const workers = Math.min(Math.max((navigator.hardwareConcurrency ?? 2) - 1, 1), MAX_WORKERS);
        this.remotes = Array.from({ length: workers }, () => new Remote(this.source));
        this.remotes.forEach(remote => remote.ask('files', { files: Object.fromEntries(dish.files) }).catch(() => {}));
        await this.begin();
        if (!matchMedia('(prefers-reduced-motion: reduce)').matches)
            this.run();
    }

    say(text, bad = false) {
        this.get('status').textContent = text;
        this.get('status').classList.toggle('error', bad);
    }

    setRange(id) {
        const { get: $ } = this, parameter = this.parameters[$(id).selectedIndex];
        $(`${id}-from`).value = parameter?.min ?? '';
        $(`${id}-to`).value = parameter?.max ?? '';
    }

    // Returns the parameter and the values of an axis; null if it is not used.
    read(id) {
        const { get: $ } = this, parameter = this.parameters[$(id).selectedIndex], number = name => Number($(`${id}-${name}`).value);
        return parameter ? { name: parameter.name, values: valuesOf(parameter, number('from'), number('to'), number('count')) } : null;
    }

    // Starts all dishes at their first frames.
    async begin() {
        const { get: $, page: { dish } } = this, [across, down] = this.axes.map(id => this.read(id)), turn = ++this.turn;
        if (!$('form').reportValidity())
            return;
        if (down?.name === across.name) {
            this.say('Choose two parameters.', true);
            return;
        }
        const rows = down?.values ?? [null], ratio = dish.canvas.width / dish.canvas.height;
        const box = $('scroll').getBoundingClientRect(), width = Math.floor(Math.min(Math.max(Math.min(
            (box.width - 90) / across.values.length - 6, ((box.height - 60) / rows.length - 6) * ratio), MIN_WIDTH), MAX_WIDTH));
        this.dialog.style.setProperty('--cell', `${width}px`);
        const scale = Math.min(globalThis.devicePixelRatio || 1, 2);
        const size = [width, width / ratio].map(length => Math.round(length * scale));
        this.cells = rows.flatMap(y => across.values.map(x => this.cell([[across.name, x], ...down ? [[down.name, y]] : []], size)));
        this.arrange(across, down, rows);
        this.say('Click a dish, or press Enter, to open it with these values. Arrow keys move between dishes.');
        this.to = FIRST_SEEN;
        this.took = 0;
        try {
            await Promise.all(this.remotes.map((remote, worker) => {
                const cells = this.of(worker).map(({ canvas, changes }) => ({ canvas: canvas.transferControlToOffscreen(), changes }));
                return remote.ask('grid', { run: 'begin', text: dish.loaded, name: dish.name, cells }, cells.map(({ canvas }) => canvas));
            }));
            if (turn === this.turn)
                await this.step();
            requestAnimationFrame(now => this.tick(now, turn));
        } catch (error) {
            this.fail(error, turn);
        }
    }

    fail(error, turn) {
        if (turn === this.turn && this.dialog.open)
            this.say(error.message, true);
    }

    // Returns the cells of a worker. Neighbours have different workers.
    of(worker) {
        return this.cells.filter((_, i) => i % this.remotes.length === worker);
    }

    cell(values, [width, height]) {
        const canvas = make('canvas', { width, height }), problem = make('span');
        const button = make('button', { type: 'button', tabIndex: -1 }, canvas, problem);
        button.ariaLabel = values.map(([name, value]) => `${name} ${value}`).join(', ');
        const changes = [...this.fixed.filter(([, name]) => !values.some(([other]) => other === name)),
            ...values.map(([name, value]) => [-1, name, String(value)])];
        const cell = { canvas, button, changes, problem, seen: true };
        button.onclick = () => this.open(cell);
        return cell;
    }

    // Makes the table, whose rows and columns have the values as headings.
    arrange(across, down, rows) {
        const [head, body] = this.dialog.querySelector('table').children;
        const heading = (scope, text) => make('th', { scope, textContent: text });
        const corner = make('td', {}, `${across.name} →`, make('br'), down ? `${down.name} ↓` : '');
        head.replaceChildren(make('tr', {}, corner, ...across.values.map(value => heading('col', value))));
        const columns = this.columns = across.values.length;
        const cellsOf = row => this.cells.slice(row * columns, (row + 1) * columns).map(({ button }) => make('td', {}, button));
        body.replaceChildren(...rows.map((value, row) => make('tr', {}, heading('row', value ?? ''), ...cellsOf(row))));
        this.cells[0].button.tabIndex = 0;
        this.observer?.disconnect();
        this.observer = new IntersectionObserver(entries => entries.forEach(({ target, isIntersecting }) => {
            this.cells.find(({ button }) => button === target).seen = isIntersecting;
        }), { root: this.get('scroll') });
        this.cells.forEach(({ button }) => this.observer.observe(button));
    }

    // Steps all dishes that are in view to frame `to`.
    async step() {
        await Promise.all(this.remotes.map(async (remote, worker) => {
            const cells = this.of(worker), which = [...cells.keys()].filter(i => cells[i].seen);
            const answer = await remote.ask('grid', { run: 'step', which, to: this.to });
            answer.cells.forEach(({ frame, problem }, i) => {
                const cell = cells[which[i]];
                cell.button.dataset.frame = frame;
                cell.problem.textContent = problem;
            });
        }));
        this.get('frame').textContent = `frame ${this.to}`;
    }

    // All dishes are at the same frame, so that they can be compared: none runs ahead while another computes.
    async tick(now, turn) {
        if (turn !== this.turn)
            return;
        const { fps } = this.page.dish, due = Math.floor((now - (this.last ?? now)) / 1000 * fps);
        const count = this.took > SLOW ? Math.min(due, 1) : Math.min(due, MAX_STEPS);
        if (!this.running || this.last === undefined) {
            this.last = now;
        } else if (count > 0) {
            this.last = now;
            this.to += count;
            try {
                await this.step();
            } catch (error) {
                this.fail(error, turn);
                return;
            }
            this.took = performance.now() - now;
        }
        requestAnimationFrame(later => this.tick(later, turn));
    }

    run() {
        this.running = true;
        this.get('run').textContent = 'Pause';
    }

    pause() {
        this.running = false;
        this.get('run').textContent = 'Run';
    }

    move(event) {
        const at = this.cells.findIndex(({ button }) => button === event.target);
        const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -this.columns, ArrowDown: this.columns }[event.key];
        const next = this.cells[at + by];
        if (at < 0 || !by)
            return;
        event.preventDefault();
        if (!next || (Math.abs(by) === 1 && Math.floor(at / this.columns) !== Math.floor((at + by) / this.columns)))
            return;
        this.cells[at].button.tabIndex = -1;
        next.button.tabIndex = 0;
        next.button.focus();
    }

    // Opens a dish in the page, at the same frame.
    async open(cell) {
        if (cell.problem.textContent) {
            this.say(`${cell.button.ariaLabel}: ${cell.problem.textContent}`, true);
            return;
        }
        const { page, running, remotes } = this, worker = this.cells.indexOf(cell) % remotes.length;
        const number = this.of(worker).indexOf(cell), { dish } = page;
        const state = await remotes[worker].ask('grid', { run: 'digest', number });
        this.rests = false;
        this.dialog.close();
        const opened = await dish.open(dish.loaded, dish.name, { changes: cell.changes, frame: state.frame, digest: state.digest });
        if (!opened)
            return;
        page.say(`${cell.button.ariaLabel}: the state of frame ${state.frame} ${opened.same ? 'is' : 'is not'} that in the grid.`,
            !opened.same);
        if (running)
            dish.run();
    }

    end() {
        this.turn++;
        this.pause();
        this.observer?.disconnect();
        this.remotes.forEach(remote => remote.end());
        this.remotes = [];
        if (this.rests)
            this.page.dish.run();
    }
}

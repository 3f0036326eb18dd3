// particle.mjs: the panel that shows the particle on which the user has clicked, and the forces on it.

const MAX_ROWS = 200;

function rowOf(cells, head = 'td') {
    const row = document.createElement('tr');
    row.append(...cells.map(content => {
        const cell = document.createElement(head);
        cell.append(content);
        return cell;
    }));
    return row;
}

export class Particle {
    // goTo: a function that shows a line of the script. choose: a function that is called when a particle was chosen.
    constructor(root, dish, goTo, choose) {
        const $ = id => root.getElementById(id);
        Object.assign(this, {
            dish, goTo, choose, title: $('particle-title'), state: $('particle-state'), origin: $('particle-origin'),
            rows: $('particle-forces'), seen: false, asking: false,
        });
        dish.canvas.addEventListener('click', event => this.pick(event));
    }

    async pick(event) {
        if (this.dish.loaded === null)
            return;
        const box = this.dish.canvas.getBoundingClientRect();
        const place = { x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height };
        const answer = await this.dish.attempt('choose', place);
        if (!answer?.found)
            return;
        this.choose();
        this.refresh();
    }

    // Requests the description of the chosen particle, one request at a time.
    async refresh() {
        if (!this.seen || this.asking || this.dish.loaded === null)
            return;
        this.asking = true;
        const answer = await this.dish.attempt('forces');
        this.asking = false;
        if (answer)
            this.show(answer);
    }

    show({ key, state = [], contributions = [], sum, frame, origin, note = sum && !contributions.length ? 'no force acts on it' : '' }) {
        const count = contributions.length;
        this.title.textContent = key === null ? 'Click a particle to see its state and the forces on it.'
            : `${key} ${note || `in frame ${frame}: ${count} contribution${count === 1 ? '' : 's'} in the order of summation`}`;
        this.state.textContent = state.map(([name, value]) => `${name} = ${value}`).join('\n');
        const { file, line, column } = origin ?? {};
        this.origin.replaceChildren(...origin ? ['made by ', this.link(`line ${line}`, file, line, column)] : []);
        this.rows.replaceChildren(...contributions.slice(0, MAX_ROWS).map(each => this.row(each)));
        if (count > MAX_ROWS)
            this.rows.append(rowOf([`and ${count - MAX_ROWS} more`, '', '', '']));
        if (sum)
            this.rows.append(rowOf(['sum', '', sum.join(';'), ''], 'th'));
    }

    link(text, file, line, column) {
        const link = document.createElement('button');
        link.textContent = text;
        link.onclick = () => this.goTo(file, line, column);
        return link;
    }

    row({ kind, partner, vector, file, line, column }) {
        const link = file ? this.link(`${file}:${line}`, file, line, column) : '';
        return rowOf([kind ?? 'own force', partner ?? '', vector.join(';'), link]);
    }
}

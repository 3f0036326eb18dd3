// table.mjs: the state as a table; the worker sends only the visible rows.

const ROWS = 100;

export class Table {
    constructor(root, dish) {
        const $ = id => root.getElementById(id);
        Object.assign(this, {
            dish, body: $('state-rows'), count: $('state-count'), digest: $('state-digest'),
            seen: false, asking: false, from: 0, by: null, down: false,
        });
        this.filter = $('state-filter');
        this.filter.oninput = () => this.go(0);
        $('state-before').onclick = () => this.go(this.from - ROWS);
        $('state-after').onclick = () => this.go(this.from + ROWS);
        this.moves = [$('state-before'), $('state-after')];
        this.heads = [...root.querySelectorAll('#panel-state th')];
        for (const head of this.heads)
            head.querySelector('button').onclick = () => this.sort(head.dataset.by);
    }

    // Handles a click on a column header. The first click sorts in ascending order, the second in descending order, and the third restores
    // the order of the state.
    sort(by) {
        [this.by, this.down] = this.by !== by ? [by, false] : this.down ? [null, false] : [by, true];
        for (const head of this.heads)
            head.setAttribute('aria-sort', head.dataset.by !== this.by ? 'none' : this.down ? 'descending' : 'ascending');
        this.go(0);
    }

    go(from) {
        this.from = Math.max(from, 0);
        this.again = true;
        this.refresh();
    }

    // Requests the visible rows, one request at a time.
    async refresh() {
        if (!this.seen || this.asking || this.dish.loaded === null)
            return;
        this.asking = true;
        do {
            this.again = false;
            const { by, down, from } = this;
            const answer = await this.dish.attempt('state', { filter: this.filter.value, by, down, from, count: ROWS });
            if (answer)
                this.show(answer);
        } while (this.again);
        this.asking = false;
    }

    show({ rows, matching, total, digest }) {
        this.body.replaceChildren(...rows.map(([key, value]) => {
            const row = document.createElement('tr'), head = document.createElement('th'), cell = document.createElement('td');
            head.scope = 'row';
            head.textContent = key;
            cell.textContent = Array.isArray(value) ? value.join('; ') : value;
            row.append(head, cell);
            return row;
        }));
        const to = this.from + rows.length;
        this.count.textContent = (matching ? `${this.from + 1} to ${to} of ${matching}` : 'no rows')
            + (matching < total ? ` (${total} without the filter)` : '');
        this.digest.textContent = digest ? `digest ${digest}` : '';
        this.moves[0].disabled = this.from === 0;
        this.moves[1].disabled = to >= matching;
    }
}

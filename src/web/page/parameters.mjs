// parameters.mjs: the script's parameters as sliders and fields.

export class Parameters {
    constructor(place, onSet) {
        this.place = place;
        this.onSet = onSet;
        this.shown = '';
        this.rows = new Map();
        this.values = new Map();
    }

    // If the script's parameters have changed, creates the rows again. Otherwise updates the values, except the value being edited.
    show(parameters) {
        const settable = parameters.filter(parameter => parameter.settable);
        const signature = JSON.stringify(settable.map(({ name, min, max, step, comment, defaultValue }) =>
            [name, min, max, step, comment, defaultValue]));
        if (signature !== this.shown) {
            this.shown = signature;
            this.rows.clear();
            this.place.replaceChildren(...settable.flatMap(parameter => this.row(parameter)));
        }
        for (const { name, value, number } of settable) {
            this.values.set(name, Number.isNaN(number) ? value : String(number));
            for (const input of this.rows.get(name))
                if (!input.matches(':focus'))
                    input.value = this.values.get(name);
        }
    }

    // Shows the value of a parameter again after the script rejected another one.
    restore(name) {
        this.rows.get(name)?.forEach(input => (input.value = this.values.get(name)));
    }

    row(parameter) {
        const { name, comment, min, max, number } = parameter, label = document.createElement('label');
        const field = document.createElement('input'), numeric = !Number.isNaN(parameter.defaultNumber);
        label.textContent = name;
        label.title = comment;
        label.htmlFor = field.id = `parameter-${name}`;
        field.type = numeric ? 'number' : 'text';
        field.title = comment;
        if (numeric)
            field.step = parameter.step || 'any';
        field.onchange = () => field.value !== '' && this.onSet(name, field.value);
        if (!numeric || !Number.isFinite(min) || !Number.isFinite(max)) {
            this.rows.set(name, [field]);
            return [label, document.createElement('span'), field];
        }
        const slider = document.createElement('input');
        const whole = [min, max, number, parameter.defaultNumber].every(Number.isInteger);
        const step = parameter.step || (whole ? 1 : (max - min) / 200);
        Object.assign(slider, { type: 'range', min: min, max: max, step, title: comment });
        slider.setAttribute('aria-label', `${name}${comment ? `: ${comment}` : ''}`);
        slider.oninput = () => {
            field.value = slider.value;
            this.onSet(name, slider.value);
        };
        this.rows.set(name, [slider, field]);
        return [label, slider, field];
    }
}

// input.mjs: reports the pointer and keys of a picture to the script.

export class Input {
    constructor(dish) {
        const { canvas } = dish;
        this.dish = dish;
        this.pressed = new Set();
        canvas.onpointerdown = event => {
            canvas.setPointerCapture(event.pointerId); // so that a drag that leaves the picture is reported
            this.point(event, true);
        };
        canvas.onpointermove = event => this.point(event, true);
        // A finger that is lifted is nowhere, but a mouse is still there.
        canvas.onpointerup = event => this.point(event, event.pointerType === 'mouse');
        canvas.onpointerleave = canvas.onpointercancel = event => this.point(event, false);
        canvas.oncontextmenu = event => dish.asksFor('pointer') && event.preventDefault();
        canvas.onkeydown = event => this.press(event);
        canvas.onkeyup = event => this.releaseKey(keyName(event));
        canvas.onblur = () => this.pressed.forEach(name => this.releaseKey(name));
    }

    point(event, inside) {
        if (this.dish.loaded === null || !event.isPrimary)
            return;
        const box = this.dish.canvas.getBoundingClientRect(), share = (x, from, size) => Math.min(Math.max((x - from) / size, 0), 1);
        const [left, right, middle] = [event.buttons & 1, event.buttons & 2, event.buttons & 4];
        this.dish.attempt('pointer', {
            inside, x: share(event.clientX, box.left, box.width), y: share(event.clientY, box.top, box.height),
            buttons: left | (middle ? 2 : 0) | (right ? 4 : 0),
        });
    }

    // Reports a key to the script. If the script asks for keys, prevents the browser from scrolling. The browser handles Tab and keys with
    // Control or Alt.
    press(event) {
        const name = keyName(event);
        if (this.dish.loaded === null || !name || event.ctrlKey || event.metaKey || event.altKey)
            return;
        if (this.dish.asksFor('key') && (event.key.length === 1 || /^(Arrow|Page|Home|End)/.test(event.key)))
            event.preventDefault();
        this.pressed.add(name);
        this.dish.ask('key', { name, pressed: true }).catch(() => {});
    }

    releaseKey(name) {
        if (this.pressed.delete(name))
            this.dish.ask('key', { name, pressed: false }).catch(() => {});
    }
}

// Maps the browser's key names to petri's key names.
const KEYS = {
    ' ': 'space', ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'up', ArrowDown: 'down', Enter: 'enter', Escape: 'escape',
    Backspace: 'backspace', Insert: 'insert', Delete: 'delete', PageUp: 'page_up', PageDown: 'page_down', Home: 'home', End: 'end',
    "'": 'apostrophe', ',': 'comma', '-': 'minus', '.': 'period', '/': 'slash', ';': 'semicolon', '=': 'equal', '[': 'left_bracket',
    '\\': 'backslash', ']': 'right_bracket', '`': 'grave_accent',
};

function keyName({ key, code }) {
    if (key === 'Shift')
        return code === 'ShiftRight' ? 'right_shift' : 'left_shift';
    return /^([a-z0-9]|F\d+)$/i.test(key) ? key.toLowerCase() : KEYS[key] ?? null;
}

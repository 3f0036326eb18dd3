// drag_numbers.mjs: numbers in the editor that change when they are dragged with Alt held down.
import { EditorView } from '@codemirror/view';
import { moved } from './number.mjs';

const NUMBER = /(?<![\p{L}\p{N}_.:#])-?(?:\d+\.?\d*|\.\d+)(?![\p{L}\p{N}_.])/gu;
const PIXELS = 4; // horizontal distance for one step

// Returns { from, to, text } of the number at a position; null if there is none.
function numberAt(state, at) {
    const { from, text } = state.doc.lineAt(at), code = text.replace(/--.*/, '');
    for (const { index, 0: found } of code.matchAll(NUMBER)) {
        // A minus after a value is an operator.
        const isOperator = found[0] === '-' && /[\p{L}\p{N}_)\]}]\s*$/u.test(code.slice(0, index));
        const start = from + index + (isOperator ? 1 : 0);
        if (start <= at && at <= from + index + found.length)
            return { from: start, to: from + index + found.length, text: isOperator ? found.slice(1) : found };
    }
    return null;
}

let drag = null; // the number that is dragged, with the horizontal position where the drag began

function begin(event, view) {
    const at = event.altKey && event.button === 0 ? view.posAtCoords({ x: event.clientX, y: event.clientY }) : null;
    const number = at === null ? null : numberAt(view.state, at);
    if (!number)
        return false;
    drag = { ...number, view, x: event.clientX, start: number.text };
    addEventListener('pointermove', go);
    addEventListener('pointerup', end, { once: true });
    return true;
}

function go(event) {
    const { view, from, to, start, x } = drag, text = moved(start, Math.round((event.clientX - x) / PIXELS));
    if (text === view.state.sliceDoc(from, to))
        return;
    view.dispatch({ changes: { from, to, insert: text }, userEvent: 'input.drag' });
    drag.to = from + text.length;
}

function end() {
    removeEventListener('pointermove', go);
    drag = null;
}

// Shows that a number can be dragged.
const hint = (event, view) => {
    const at = event.altKey ? view.posAtCoords({ x: event.clientX, y: event.clientY }) : null;
    view.contentDOM.style.cursor = drag || (at !== null && numberAt(view.state, at)) ? 'ew-resize' : '';
};

export const dragNumbers = EditorView.domEventHandlers({ mousedown: begin, mousemove: hint });

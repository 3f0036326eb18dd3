// try.mjs: examples with text results. When the reader changes the script, the new result is shown. The engine is loaded when the first
// example is changed.
import { engineFile, loadEngine } from '../engine/petri.mjs';

const LIMITS = { work: 2 ** 22, memory: 256 << 20 }; // limits of a script, which are low because the page cannot respond during a call
const PAUSE = 250; // ms between the last key press and the evaluation
let engine = null;

// Returns the result of a script in the format of the manual.
export function outcome(from, { kind, frame, text, files }) {
    const session = from.open({ ...LIMITS, files });
    try {
        if (kind === 'eval')
            return session.load('') && text.trimEnd().split('\n').map(line => {
                try {
                    return line.trim() ? session.evaluate(line).text : '';
                } catch (error) {
                    return error.diagnostics?.find(({ level }) => level === 'error')?.text ?? 'error';
                }
            }).join('\n');
        const said = [];
        session.onDiagnostic = ({ rendered }) => said.push(rendered.trimEnd());
        session.load(text);
        for (let i = 0; i <= frame; i++)
            session.step();
        return [session.print(kind).replace(/^@.*\n/, '').trimEnd(), ...said].join('\n');
    } catch (error) {
        return error.diagnostics?.length ? error.diagnostics.map(({ rendered }) => rendered.trimEnd()).join('\n') : error.message;
    } finally {
        if (!from.broken)
            session.close();
    }
}

function change(place, button) {
    const [script, result] = place.querySelectorAll('pre'), text = document.createElement('textarea');
    const { kind, frame, files } = place.dataset;
    Object.assign(text, { value: script.textContent, rows: script.textContent.trimEnd().split('\n').length + 1, spellcheck: false });
    text.setAttribute('aria-label', 'Example script');
    result.setAttribute('role', 'status');
    script.replaceWith(text);
    button.remove();
    text.focus();
    let waits;
    const show = async () => {
        engine ??= loadEngine(new URL(`../petri/${engineFile()}`, import.meta.url));
        if ((await engine).broken)
            engine = loadEngine((await engine).module);
        result.textContent = outcome(await engine, { kind, frame: Number(frame), text: text.value, files: JSON.parse(files ?? '{}') });
    };
    text.oninput = () => {
        clearTimeout(waits);
        waits = setTimeout(show, PAUSE);
    };
    text.onkeydown = event => event.key === 'Enter' && event.ctrlKey && show();
}

if (globalThis.document)
    for (const place of document.querySelectorAll('.try')) {
        const button = Object.assign(document.createElement('button'), { textContent: 'Edit' });
        button.onclick = () => change(place, button);
        place.prepend(button);
    }

// embed.mjs: <petri-dish>, an element that runs a script in any page. src/manual/playground.md lists its attributes and events. The engine
// is loaded from this file's folder when the element comes into view.
import { engineFile, loadEngine } from '../engine/petri.mjs';
import { CONTROLS, Controls } from './controls.mjs';
import { Dish, errorText, unsupportedText } from './dish.mjs';
import style from './embed.css';
import { coloured } from './flitter.mjs';
import { packLink } from './link.mjs';

// The engine, which is fetched and compiled once for all elements of a page.
let compiled = null;
const engine = () => (compiled ??= loadEngine(new URL(`petri/${engineFile()}`, import.meta.url)).then(({ module }) => module));

const MAX_PROBLEMS = 4; // maximum number of problems shown below a picture

// A constant, so that attributes of the element are never inserted as HTML.
const TEMPLATE = `<style>${style}</style>
<div id="frame" part="frame"><canvas id="picture" part="picture" tabindex="0" width="300" height="150"></canvas>
<button id="start" aria-label="Run">▶</button></div>
<div id="below" hidden>${CONTROLS}<a id="open" part="link" target="_blank" rel="noopener">Open in petri</a></div>
<div id="editor" hidden><pre id="colours" aria-hidden="true"></pre>
<textarea id="text" part="text" spellcheck="false" autocapitalize="off" aria-label="The script"></textarea></div>
<p id="message" part="message" role="status"></p>`;

class PetriDish extends HTMLElement {
    static observedAttributes = ['src', 'controls', 'editor'];

    connectedCallback() {
        if (!this.shadowRoot)
            this.attachShadow({ mode: 'open' }).innerHTML = TEMPLATE;
        this.get = id => this.shadowRoot.getElementById(id);
        this.arrange();
        // The parser may add the element's content later than the element itself.
        this.seen = new IntersectionObserver(entries => this.look(entries.at(-1).isIntersecting), { rootMargin: '300px' });
        if (document.readyState === 'loading')
            document.addEventListener('DOMContentLoaded', () => this.seen?.observe(this), { once: true });
        else
            this.seen.observe(this);
    }

    disconnectedCallback() {
        this.seen.disconnect();
        this.seen = null;
        this.dish?.end();
        this.dish = null;
    }

    // Starts the element when it first comes into view. Pauses a running script while it is out of view.
    look(inView) {
        if (!this.dish && inView)
            this.begin();
        else if (this.rests && inView)
            this.dish.run();
        this.rests = !inView && (this.rests || this.running);
        if (this.rests)
            this.dish.pause();
    }

    attributeChangedCallback(name) {
        if (!this.get)
            return;
        this.arrange();
        if (name === 'src' && this.dish)
            this.read().then(() => this.reset());
    }

    arrange() {
        this.get('below').hidden = !this.hasAttribute('controls');
        this.get('editor').hidden = !this.hasAttribute('editor');
        this.get('picture').setAttribute('aria-label', this.getAttribute('label') ?? 'The picture of the script');
    }

    say(text, bad = false) {
        this.get('message').textContent = text;
        this.get('message').classList.toggle('error', bad);
    }

    emit(type, detail) {
        this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true }));
    }

    // Starts the engine and shows the first picture; further calls have no effect.
    async begin() {
        if (this.dish || !this.isConnected)
            return;
        const dish = this.dish = new Dish(this.get('picture'), {
            shown: (answer, left) => this.shown(answer, left), failed: (error, reported) => this.failed(error, reported),
            changed: () => this.changed(), loaded: () => this.say(''),
            restored: () => this.say(''), ran: rate => this.controls.ran(rate),
        }, { source: engine() });
        this.controls = new Controls(this.shadowRoot, dish, options => this.ready(options));
        dish.listen();
        this.get('start').onclick = () => this.run();
        this.get('open').onclick = event => this.linkOut(event);
        this.get('text').oninput = () => this.colour();
        this.get('text').onscroll = () => this.align();
        this.get('text').onkeydown = event => {
            if (event.key === 'Enter' && (event.ctrlKey || event.metaKey))
                this.run({ always: true });
        };
        try {
            await dish.ready;
            await this.read();
        } catch (error) {
            this.failed(error, []);
            return;
        }
        if (this.dish !== dish)
            return;
        const frame = Number(this.getAttribute('frame') ?? 0);
        const shown = await dish.open(this.text, this.name, { frame: Number.isInteger(frame) && frame > 0 ? frame : 0 });
        if (shown && this.hasAttribute('autoplay') && !matchMedia('(prefers-reduced-motion: reduce)').matches)
            dish.run();
        this.emit('petri-ready', { frame: dish.frame });
    }

    // Reads the script from `src`, and the files named by `files` from the same folder. Without `src`, the script is the content of the
    // element, and the files are in the folder of the page.
    async read() {
        const from = this.getAttribute('src'), url = new URL(from ?? '', document.baseURI);
        const fetched = async (name, place = new URL(name, url)) => {
            const answer = await fetch(place);
            if (!answer.ok)
                throw new Error(`cannot read ${name}: the server returned status ${answer.status}`);
            return new Uint8Array(await answer.arrayBuffer());
        };
        for (const name of (this.getAttribute('files') ?? '').split(/\s+/).filter(Boolean))
            await this.dish.addFile(name, await fetched(name));
        await this.dish.giveFiles();
        this.name = url.pathname.match(/[^/]+\.fl$/)?.[0] ?? 'script.fl';
        this.text = from === null ? plain((this.querySelector('script, template, pre') ?? this).textContent)
            : new TextDecoder().decode(await fetched(from, url));
    }

    get text() {
        return this.get?.('text').value ?? '';
    }

    set text(text) {
        this.get('text').value = text;
        this.get('text').rows = Math.min(text.split('\n').length, 24);
        this.colour();
    }

    // Shows the script in colours behind the text, whose letters are transparent.
    colour() {
        this.get('colours').replaceChildren(...coloured(this.text));
        this.align();
    }

    align() {
        const { scrollLeft, scrollTop } = this.get('text');
        Object.assign(this.get('colours'), { scrollLeft, scrollTop });
    }

    async ready({ always = false } = {}) {
        await this.begin();
        return (!always && this.dish.loaded === this.text) || this.dish.load(this.text, this.name);
    }

    async run(options) {
        if (await this.ready(options))
            this.dish.run();
    }

    pause() {
        this.dish?.pause();
    }

    async reset() {
        return this.ready({ always: true });
    }

    async seek(frame) {
        if (await this.ready())
            await this.dish.seek(frame);
    }

    async set(name, value) {
        if (await this.ready())
            await this.dish.set(name, String(value));
    }

    get frame() {
        return this.dish?.frame ?? -1;
    }

    get running() {
        return this.dish?.running ?? false;
    }

    // Warnings are only shown if the user can edit the script.
    shown(answer, left) {
        const problems = this.hasAttribute('editor') ? answer.reported.filter(({ level }) => level !== 'note') : [];
        if (problems.length)
            this.say(problems.slice(0, MAX_PROBLEMS).map(({ rendered }) => rendered.trimEnd()).join('\n'));
        else if (left.length)
            this.say(unsupportedText(answer, left), answer.picture.lost);
        this.controls.show(answer);
        this.get('picture').dataset.frame = answer.frame;
        this.emit('petri-frame', { frame: answer.frame, time: answer.time });
    }

    failed(error, reported) {
        const [problem] = reported.filter(({ level }) => level !== 'note');
        this.say(problem?.rendered ?? errorText(error), true);
        this.emit('petri-error', { message: error.message, diagnostics: reported });
    }

    changed() {
        this.controls?.refresh();
        this.get('start').hidden = this.dish?.running || this.hasAttribute('controls') || this.dish?.frame > 2;
    }

    // Opens the playground with a link to the current script.
    async linkOut(event) {
        event.preventDefault();
        const answer = this.dish.loaded === this.text ? await this.dish.attempt('digest') : null;
        const link = await packLink({ text: this.text, name: this.name, ...(answer ?? {}) }).catch(error => this.say(error.message, true));
        if (link)
            open(new URL('./', import.meta.url).href + link, '_blank', 'noopener');
    }
}

// Returns a script from HTML without surrounding blank lines and common indentation.
function plain(text) {
    const lines = text.replace(/^\s*\n/, '').trimEnd().split('\n');
    const indent = Math.min(...lines.filter(line => line.trim()).map(line => line.match(/^ */)[0].length));
    return `${lines.map(line => line.slice(indent)).join('\n')}\n`;
}

if (!customElements.get('petri-dish'))
    customElements.define('petri-dish', PetriDish);

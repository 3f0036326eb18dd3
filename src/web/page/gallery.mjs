// gallery.mjs: the dialog with the user's scripts and the samples. Their pictures are those of the manual; others are computed when they
// are shown. The picture under the pointer, or with the focus, moves.
import { Dish } from './dish.mjs';
import { makeElement } from './element.mjs';

const WIDTH = 320, HEIGHT = 240;
const FRAME = 60; // the frame of a thumbnail
const FRAMES = { 'dish.fl': 150, 'orbits.fl': 200, 'trails.fl': 200, 'aquarium.fl': 240, 'terrain.fl': 200, 'petri.fl': 20 };
const LAST = ['solids.fl', 'metaballs.fl', 'bubble.fl', 'petri.fl']; // scenes, which take long without a graphics card

// Returns the first sentence of the script's first comment.
const describe = text => (text.match(/^-- (.*)/m)?.[1] ?? '').split(/[.:](?=\s|$)/)[0];

export class Gallery {
    // page: has scripts (scripts.mjs), the dish, samples and openText(). source: the engine (engine.mjs).
    constructor(root, page, source) {
        const $ = id => root.getElementById(id);
        Object.assign(this, { page, source, dialog: $('gallery'), own: $('own-scripts'), none: $('no-scripts'), cards: [], wanted: null });
        $('scripts').onclick = () => this.show();
        $('gallery-new').onclick = () => this.leave(() => page.scripts.create());
        $('gallery-close').onclick = () => this.dialog.close();
        this.dialog.onclose = () => this.end();
        const names = Object.keys(page.samples), first = names.filter(name => !LAST.includes(name));
        this.cards = [...first, ...names.filter(name => LAST.includes(name))].map(name => this.card(name, page.samples[name]));
        $('sample-cards').append(...this.cards.map(({ item }) => item));
    }

    // Opens the dialog. Meanwhile the page's script rests, so that the thumbnails do not wait for it.
    show() {
        this.cards.forEach(card => this.load(card));
        this.rests = this.page.dish.running;
        this.page.dish.pause();
        this.fill();
        this.dialog.showModal();
        this.work();
    }

    // Closes the dialog and opens a script.
    leave(open) {
        this.rests = false;
        this.dialog.close();
        open();
    }

    // --- the user's scripts

    fill() {
        const { scripts } = this.page, all = scripts.library.list();
        this.none.hidden = all.length > 0;
        this.own.replaceChildren(...all.map(script => this.row(script)));
    }

    row({ id, name, text, when }) {
        const { scripts } = this.page, item = makeElement('li'), button = (textContent, label, onclick) =>
            makeElement('button', { type: 'button', textContent, onclick, ariaLabel: label });
        const open = button(name, `Open ${name}`, () => this.leave(() => scripts.open(id)));
        open.className = 'name';
        if (id === scripts.id)
            open.setAttribute('aria-current', 'true');
        const remove = button('Delete', `Delete ${name}`, () => {
            scripts.remove(id);
            const undo = button('Undo', `Undo deleting ${name}`, () => {
                scripts.library.keep(id, name, text, when);
                item.replaceWith(this.row({ id, name, text, when }));
            });
            item.replaceChildren(makeElement('span', { textContent: `${name} is deleted.` }), undo);
            undo.focus();
        });
        const edited = new Date(when).toLocaleString([], { dateStyle: 'medium', timeStyle: 'short' });
        item.append(open, makeElement('time', { textContent: edited }),
            button('Duplicate', `Duplicate ${name}`, () => this.leave(() => scripts.duplicate(id))), remove);
        return item;
    }

    // --- samples

    card(name, text) {
        const canvas = makeElement('canvas', { width: WIDTH, height: HEIGHT, ariaHidden: 'true' });
        const button = makeElement('button', { type: 'button' }, canvas, makeElement('strong', { textContent: name.replace(/\.fl$/, '') }),
            makeElement('span', { textContent: describe(text) }));
        const card = { name, text, canvas, item: makeElement('li', {}, button), drawn: false };
        button.onclick = () => this.leave(() => this.page.openText(text, name, { play: true }));
        button.onpointerenter = button.onfocus = () => this.run(card);
        button.onpointerleave = button.onblur = () => this.wanted === card && this.run(null);
        return card;
    }

    // Shows the picture of the manual, if the sample has one and it can be loaded.
    async load(card) {
        const src = this.page.pictures[card.name];
        if (!src || card.picture)
            return;
        card.picture = makeElement('img', { src });
        card.drawn = true;
        try {
            await card.picture.decode();
            if (this.current !== card)
                this.copy(card.picture, card);
        } catch {
            card.drawn = false;
            this.work();
        }
    }

    // Makes the picture of a card move, or of no card if it is null.
    run(card) {
        this.wanted = matchMedia('(prefers-reduced-motion: reduce)').matches ? null : card;
        this.left?.();
        this.work();
    }

    // Draws the thumbnails, one after the other, in an engine that exists while the dialog is open.
    async work() {
        if (this.working || !this.dialog.open)
            return;
        this.working = true;
        for (let card; this.dialog.open && (card = this.wanted ?? this.cards.find(({ drawn }) => !drawn));) {
            const dish = await this.begin();
            this.current = card;
            await dish.open(card.text, card.name, { frame: FRAMES[card.name] ?? FRAME });
            card.drawn ||= dish === this.dish; // otherwise the dialog was closed
            if (card !== this.wanted || dish !== this.dish)
                continue;
            dish.run();
            await new Promise(resolve => (this.left = resolve));
            dish.pause();
        }
        this.working = false;
    }

    async begin() {
        if (this.dish)
            return this.dish;
        const { page, source } = this, stage = makeElement('canvas'), ignore = () => {};
        this.dish = new Dish(stage, { shown: () => this.copy(stage, this.current), failed: ignore, changed: ignore }, { source });
        const { dish } = this;
        Object.assign(dish, { files: page.dish.files, images: page.dish.images });
        await dish.giveFiles();
        return dish;
    }

    // Copies a picture to a card, which it covers.
    copy(picture, { canvas }) {
        const context = canvas.getContext('2d'), scale = Math.max(WIDTH / picture.width, HEIGHT / picture.height);
        const [width, height] = [picture.width * scale, picture.height * scale];
        context.imageSmoothingQuality = 'high';
        context.clearRect(0, 0, WIDTH, HEIGHT);
        context.drawImage(picture, (WIDTH - width) / 2, (HEIGHT - height) / 2, width, height);
    }

    end() {
        this.wanted = null;
        this.left?.();
        this.dish?.end();
        this.dish = null;
        if (this.rests)
            this.page.dish.run();
    }
}

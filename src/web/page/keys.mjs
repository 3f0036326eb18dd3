// keys.mjs: the keys of the page, the list of them, and full screen.

export class Keys {
    // page: has the dish, live and editor. actions: save and savePicture, functions.
    constructor(root, page, actions) {
        const $ = id => root.getElementById(id);
        Object.assign(this, { page, actions, frame: $('frame'), dialog: $('keys'), places: [$('frame'), $('below'), $('parameters')] });
        $('help').onclick = () => this.dialog.showModal();
        $('keys-close').onclick = () => this.dialog.close();
        $('full').hidden = !root.fullscreenEnabled;
        $('full').onclick = () => this.toggleFullScreen();
        root.addEventListener('keydown', event => this.press(event));
    }

    // Keys of one letter work while the focus is on the picture or its controls, like those of `petri view`. Keys that a script asks for
    // with !key go to the script.
    press(event) {
        const { key, target } = event, withControl = event.ctrlKey || event.metaKey;
        if (withControl && !event.altKey && key.toLowerCase() === 's') {
            event.preventDefault();
            this.actions.save();
        }
        const { dish } = this.page, isText = target.matches?.('input:not([type=range]), select, textarea, [contenteditable=true]');
        if (withControl || event.altKey || event.defaultPrevented || isText || (target === dish.canvas && dish.asksFor('key'))
            || document.querySelector('dialog[open]'))
            return;
        const act = this.places.some(place => place.contains(target)) && !(key === ' ' && target.matches('button'))
            ? this.actOf(key) : key === '?' ? () => this.dialog.showModal() : null;
        if (act) {
            event.preventDefault();
            act();
        }
    }

    actOf(key) {
        const { controls, dish, live } = this.page;
        return {
            ' ': () => controls.toggle(() => live.ready()), '.': () => dish.loaded !== null && dish.step(),
            ',': () => dish.frame > 0 && dish.seek(dish.frame - 1), r: () => this.restart(), f: () => this.toggleFullScreen(),
            s: this.actions.savePicture, h: () => this.dialog.showModal(), '?': () => this.dialog.showModal(),
        }[key];
    }

    async restart() {
        const { dish, live } = this.page, { running } = dish;
        if (await live.restart() && running)
            dish.run();
    }

    toggleFullScreen() {
        if (document.fullscreenElement)
            document.exitFullscreen();
        else
            this.frame.requestFullscreen?.().catch(() => {});
    }
}

// tabs.mjs: a tab list with panels, only one of which is visible. Arrow keys select the next or previous tab and move the focus to it.

export class Tabs {
    // change: a function that is called with the id of the visible panel.
    constructor(list, change) {
        this.tabs = [...list.querySelectorAll('[role=tab]')];
        this.change = change;
        for (const tab of this.tabs) {
            tab.onclick = () => this.choose(tab);
            tab.onkeydown = event => {
                const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
                if (!by)
                    return;
                event.preventDefault();
                const next = this.tabs[(this.tabs.indexOf(tab) + by + this.tabs.length) % this.tabs.length];
                this.choose(next);
                next.focus();
            };
        }
        this.choose(this.tabs[0]);
    }

    choose(chosen) {
        for (const tab of this.tabs) {
            const is = tab === chosen;
            tab.setAttribute('aria-selected', is);
            tab.tabIndex = is ? 0 : -1;
            document.getElementById(tab.getAttribute('aria-controls')).hidden = !is;
        }
        this.seen = chosen.getAttribute('aria-controls');
        this.change(this.seen);
    }
}

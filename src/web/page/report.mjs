// report.mjs: the callbacks of pages with a script and a picture, which report the answers of the dish.
import { errorText, unsupportedText } from './dish.mjs';
import { Live } from './live.mjs';
import { say } from './message.mjs';

const EMPTY = 'This script draws nothing: it has no `!window`.';

// Returns callbacks for Dish, which pass its answers to the modules of `page`: live, problems and controls. `page.file` is the name of the
// script in diagnostics.
export function reportTo(page) {
    let empty = false;
    return {
        loaded() {
            say('');
            empty = false;
            page.live.loaded();
            page.problems.show([], page.file);
        },
        checked: answer => page.live.checked(answer),
        shown(answer, left) {
            if (!page.live.outdated)
                page.problems.add(answer.reported);
            page.controls.show(answer);
            if (left.length)
                say(unsupportedText(answer, left), answer.picture.lost);
            if (empty !== !answer.drawable)
                say((empty = !answer.drawable) ? EMPTY : '');
            document.body.dataset.frame = answer.frame;
        },
        ran: rate => page.controls.ran(rate),
        failed(error, reported) {
            page.problems.add(reported);
            say(Live.describe(error) ?? errorText(error), true);
        },
        changed: () => page.controls.refresh(),
        restored: () => say(''),
    };
}

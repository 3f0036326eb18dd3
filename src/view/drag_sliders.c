// drag_sliders.c: dragging of the sliders in the window; see view.h.
//
// Events only store the last value. view_apply_drag sets the parameter, so that many movements of the pointer cost one
// change.
#include "petri-live.h"
#include "view/parameter_step.h"
#include "view/view.h"

void view_toggle_sliders(View *view) {
    Sliders *sliders = &view->overlay.sliders;
    if (!view->kind->scale) {
        view_notice(view, "the terminal has no sliders: tab, up and down change parameters");
        return;
    }
    sliders->shown = !sliders->shown;
    sliders_update(sliders, view->live.session);
    if (sliders->shown && sliders->count == 0)
        view_notice(view, "no parameter has a range; 'let SIZE=SIZE or 20 -- 1..50' gives one");
    sliders->shown = sliders->shown && sliders->count > 0;
    view->dragged = -1;
    view->redraw = true;
}

bool view_drag_slider(View *view, const Event *event, unsigned buttons_before) {
    const Sliders *sliders = &view->overlay.sliders;
    if (!sliders->shown || windows_find(view, event->display) || view->overlay.error_text[0] != '\0')
        return false;
    double scale = view->kind->scale(view->display);
    int at = event->inside ? sliders_find(sliders, event->x / scale, event->y / scale) : -1;
    bool pressed = event->buttons & PETRI_BUTTON_LEFT, dragging = view->dragged >= 0;
    if (pressed && at >= 0 && buttons_before == 0)
        view->dragged = at;
    if (!pressed || view->dragged >= (int)sliders->count)
        view->dragged = -1;
    PetriParameter parameter;
    if (view->dragged >= 0 &&
        petri_parameter(view->live.session, sliders->items[view->dragged].parameter, &parameter, sizeof parameter)) {
        double to = parameter_at(&parameter, sliders_fraction(event->x / scale));
        view->dragged_further = to != parameter.number;
        view->dragged_to = to;
        view->parameters.chosen = sliders->items[view->dragged].parameter;
    }
    return dragging || view->dragged >= 0 || (at >= 0 && buttons_before == 0);
}

void view_apply_drag(View *view) {
    if (!view->dragged_further)
        return;
    SCOPED_TEXT text = {0};
    view->dragged_further = false;
    if (parameter_set(&view->parameters, &view->live, view->dragged_to, &text) == PARAMETER_CHANGED)
        view->step_once = view->step_once || view->paused;
    view_notice(view, "%s", text.bytes);
    view_update_status(view);
    view_update_error_text(view);
    sliders_update(&view->overlay.sliders, view->live.session);
    view->redraw = true;
}

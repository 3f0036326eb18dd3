// windows.c: the windows of a script besides the first.
#include "view/view.h"

// Selects the first window after `after` whose picture can be shown. Returns its number, or -1 if there is none.
static int select_next(PetriPicture *picture, int after) {
    int window = petri_picture_next_window(picture, after);
    while (window >= 0 && petri_picture_select(picture, window) != PETRI_OK)
        window = petri_picture_next_window(picture, window);
    return window;
}

static bool is_any_visible(const View *view) {
    bool visible = !view->hidden;
    for (int i = 0; i < view->other_count; i++)
        visible = visible || !view->others[i].hidden;
    return visible;
}

static void close_last(View *view) {
    view->kind->close(view->others[--view->other_count].display);
}

// Opens a pane or updates its size and title. Returns false if no pane can be opened.
static bool update_pane(View *view, int index, PetriPicture *picture, int window) {
    Pane *pane = &view->others[index];
    int width, height;
    petri_picture_size(picture, &width, &height);
    const char *title = petri_picture_title(picture);
    title = title[0] != '\0' ? title : view->live.options->script;
    if (index == view->other_count) {
        *pane = (Pane){.width = width, .height = height};
        overlay_set(pane->title, sizeof pane->title, title);
        pane->display = view->kind->open_another(view->display, pane->title, width, height);
        view->other_count += pane->display ? 1 : 0;
    }
    if (!pane->display)
        return false;
    pane->window = window;
    if (overlay_set(pane->title, sizeof pane->title, title))
        view->kind->set_title(pane->display, pane->title);
    if (width != pane->width || height != pane->height)
        view->kind->resize(pane->display, width, height);
    pane->width = width;
    pane->height = height;
    return true;
}

void windows_follow(View *view) {
    PetriPicture *picture = view->live.picture;
    int first = petri_picture_window(picture), window = first, count = 0;
    if (!view->display || !view->kind->open_another)
        return;
    if (picture && view->live.all_windows) {
        while (count < MAX_OTHERS && (window = select_next(picture, window)) >= 0 &&
               update_pane(view, count, picture, window))
            count++;
        petri_picture_select(picture, first);
    }
    while (view->other_count > count)
        close_last(view);
    if (view->hidden && !is_any_visible(view))
        view->closing = true; // the script has removed the windows that the user has not closed
}

void windows_draw(View *view, PetriPicture *picture) {
    static const Overlay none;
    int first = petri_picture_window(picture), window = first;
    for (int i = 0; i < view->other_count && !view->broken; i++) {
        const Pane *pane = &view->others[i];
        window = picture && (i == 0 || window >= 0) ? select_next(picture, window) : -1;
        if (!pane->hidden)
            live_script_check_drawn(&view->live, view_show(view, pane->display, window >= 0 ? picture : NULL, &none));
    }
    if (view->other_count > 0 && picture)
        petri_picture_select(picture, first);
}

Pane *windows_find(View *view, const Display *display) {
    for (int i = 0; i < view->other_count; i++)
        if (view->others[i].display == display)
            return &view->others[i];
    return NULL;
}

bool windows_hide(View *view, Display *display) {
    Pane *pane = windows_find(view, display);
    if (!view->kind->hide || view->other_count == 0)
        return false;
    view->kind->hide(pane ? display : view->display);
    if (pane)
        pane->hidden = true;
    else
        view->hidden = true;
    return is_any_visible(view);
}

void windows_close(View *view) {
    while (view->other_count > 0)
        close_last(view);
}

// picture.c: `.show`: the frame's picture in the terminal.
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "repl/repl.h"
#include "view/terminal_picture.h"

enum { DEFAULT_COLUMNS = 78, DEFAULT_ROWS = 30 };

// Of the terminal, with a line left for the prompt.
static void find_room(int *columns, int *rows) {
    struct winsize size;
    bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 2;
    *columns = known ? size.ws_col : DEFAULT_COLUMNS;
    *rows = known ? size.ws_row - 2 : DEFAULT_ROWS;
}

static PetriStatus draw(Repl *repl, PetriPicture *picture, uint32_t *pixels, const TerminalCells *cells) {
    PetriPainter *painter = petri_painter_open();
    if (painter == NULL) {
        return PETRI_MEMORY;
    }
    PetriStatus status =
        petri_picture_draw(picture, painter, pixels, cells->width, cells->height, (size_t)cells->width * 4);
    petri_picture_tell(repl->session, picture);
    petri_painter_close(&painter);
    return status;
}

static PetriStatus show(Repl *repl, PetriPicture *picture) {
    int columns = 0, rows = 0, width = 0, height = 0;
    TerminalPicture *way = terminal_picture_new(STDOUT_FILENO, repl->colour);
    if (way == NULL) {
        return PETRI_MEMORY;
    }
    find_room(&columns, &rows);
    petri_picture_size(picture, &width, &height);
    TerminalCells cells = terminal_picture_fit(way, columns, rows, width, height);
    uint32_t *pixels = memory_zeroed((size_t)cells.width * (size_t)cells.height * sizeof *pixels);
    PetriStatus status = draw(repl, picture, pixels, &cells);
    size_t length = 0;
    char *text = status == PETRI_OK ? terminal_picture_text(way, pixels, &cells, &length) : NULL;
    if (text != NULL) {
        output_write(&repl->output, text, length);
        output_write(&repl->output, "\n", 1);
    } else if (status == PETRI_OK) {
        status = PETRI_MEMORY;
    }
    free(text);
    free(pixels);
    terminal_picture_free(way);
    return status;
}

bool repl_show_picture(Repl *repl) {
    if (!terminal_picture_possible()) {
        return repl_fail(repl, "this petri was built without libchafa: it cannot show pictures in the terminal");
    }
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    repl_complete_frame(repl);
    repl_busy(repl);
    PetriStatus status = petri_preview(repl->session);
    if (status == PETRI_OK) {
        status = petri_picture(repl->session, &options, &picture);
    }
    if (status == PETRI_OK) {
        status = show(repl, picture);
    }
    repl_idle(repl);
    petri_picture_free(&picture);
    return repl_status(repl, status);
}

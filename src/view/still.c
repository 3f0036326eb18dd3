// still.c: implementation of still.h.
#include "view/still.h"

#include "base/file.h"
#include "cli/memory.h"
#include "cli/progress.h"
#include "cli/shader_test.h"
#include "view/terminal_picture.h"

#include <stdlib.h>
#include <unistd.h>

enum { DEFAULT_COLUMNS = 78, DEFAULT_ROWS = 30 };

static PetriStatus write_picture(PetriPicture *picture, PetriPainter *painter, TerminalPicture *renderer, int below,
                                 PetriWriteCallback *write, void *user_data) {
    int columns = DEFAULT_COLUMNS, rows = DEFAULT_ROWS + below, width = 0, height = 0;
    terminal_extent(STDOUT_FILENO, &columns, &rows);
    petri_picture_size(picture, &width, &height);
    TerminalCells cells = terminal_picture_fit(renderer, columns, rows > below ? rows - below : 1, width, height);
    uint32_t *pixels = memory_calloc((size_t)cells.width * (size_t)cells.height * sizeof *pixels);
    PetriStatus status =
        petri_picture_draw(picture, painter, pixels, cells.width, cells.height, (size_t)cells.width * sizeof *pixels);
    size_t length = 0;
    SCOPED_STRING text = status == PETRI_OK ? terminal_picture_text(renderer, pixels, &cells, &length) : NULL;
    free(pixels);
    if (text) {
        write(user_data, text, length);
        write(user_data, "\n", 1);
    }
    return status == PETRI_OK && !text ? PETRI_OUT_OF_MEMORY : status;
}

PetriStatus still_show(PetriSession *session, PetriPainter *painter, bool colour, int below, PetriWriteCallback *write,
                       void *user_data) {
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriStatus status = petri_picture(session, &options, &picture);
    if (status != PETRI_OK)
        return status;
    static ShaderTester tester;
    PetriPainter *own = !painter ? painter_open_tested(&tester) : NULL;
    painter = !painter ? own : painter;
    TerminalPicture *renderer = terminal_picture_new(STDOUT_FILENO, colour);
    status =
        painter && renderer ? write_picture(picture, painter, renderer, below, write, user_data) : PETRI_OUT_OF_MEMORY;
    petri_picture_report(session, picture);
    terminal_picture_free(renderer);
    petri_painter_close(&own);
    petri_picture_free(&picture);
    return status;
}

bool still_show_pixels(const uint32_t *pixels, int width, int height, bool colour, int below) {
    int columns = DEFAULT_COLUMNS, rows = DEFAULT_ROWS + below;
    size_t length = 0;
    TerminalPicture *renderer = terminal_picture_new(STDOUT_FILENO, colour);
    if (!renderer)
        return false;
    terminal_extent(STDOUT_FILENO, &columns, &rows);
    TerminalCells cells = terminal_picture_fit(renderer, columns, rows > below ? rows - below : 1, width, height);
    cells.width = width;
    cells.height = height;
    SCOPED_STRING text = terminal_picture_text(renderer, pixels, &cells, &length);
    terminal_picture_free(renderer);
    return text && file_write(STDOUT_FILENO, text, length) && file_write(STDOUT_FILENO, "\n", 1);
}

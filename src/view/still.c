// still.c: see still.h.
#include "view/still.h"

#include <stdlib.h>
#include <unistd.h>

#include "cli/bytes.h"
#include "cli/progress.h"
#include "view/terminal_picture.h"

enum { DEFAULT_COLUMNS = 78, DEFAULT_ROWS = 30 };

static PetriStatus write_picture(PetriPicture *picture, PetriPainter *painter, TerminalPicture *way, int below,
                                 PetriWrite *write, void *host) {
    int columns = DEFAULT_COLUMNS, rows = DEFAULT_ROWS + below, width = 0, height = 0;
    terminal_extent(STDOUT_FILENO, &columns, &rows);
    petri_picture_size(picture, &width, &height);
    TerminalCells cells = terminal_picture_fit(way, columns, rows > below ? rows - below : 1, width, height);
    uint32_t *pixels = memory_zeroed((size_t)cells.width * (size_t)cells.height * sizeof *pixels);
    PetriStatus status =
        petri_picture_draw(picture, painter, pixels, cells.width, cells.height, (size_t)cells.width * sizeof *pixels);
    size_t length = 0;
    SCOPED_TEXT text = status == PETRI_OK ? terminal_picture_text(way, pixels, &cells, &length) : NULL;
    free(pixels);
    if (text != NULL) {
        write(host, text, length);
        write(host, "\n", 1);
    }
    return status == PETRI_OK && text == NULL ? PETRI_MEMORY : status;
}

PetriStatus still_show(PetriSession *session, PetriPainter *painter, bool colour, int below, PetriWrite *write,
                       void *host) {
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriStatus status = petri_picture(session, &options, &picture);
    if (status != PETRI_OK) {
        return status;
    }
    PetriPainter *own = painter == NULL ? petri_painter_open() : NULL;
    painter = painter == NULL ? own : painter;
    TerminalPicture *way = terminal_picture_new(STDOUT_FILENO, colour);
    status = painter != NULL && way != NULL ? write_picture(picture, painter, way, below, write, host) : PETRI_MEMORY;
    petri_picture_tell(session, picture);
    terminal_picture_free(way);
    petri_painter_close(&own);
    petri_picture_free(&picture);
    return status;
}

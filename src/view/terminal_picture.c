// terminal_picture.c: see terminal_picture.h.
//
// The abilities of the terminal are found once, from environment variables, without a request to which it might not
// answer. Only the size of its cells is read again for each picture.
#include "view/terminal_picture.h"

#include "base/os.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#ifdef HAVE_CHAFA
#include <chafa.h>

// CELL_: the size of a cell in pixels if the terminal does not report it. DRAWN_: the number of pixels drawn per cell
// of text. Symbols show about 2 x 2 pixels per cell, and drawing more pixels is slow without a graphics card.
enum { CELL_WIDTH = 8, CELL_HEIGHT = 16, DRAWN_WIDTH = 3, DRAWN_HEIGHT = 6 };

struct TerminalPicture {
    int fd;
    ChafaTermInfo *terminal;
    ChafaSymbolMap *symbols;
    ChafaCanvasMode colours;
    ChafaPixelMode pixels;
};

bool terminal_picture_possible(void) {
    return true;
}

// Returns true if the environment selects UTF-8 according to the C library's rules. The result is independent
// of setlocale, which petri view never calls.
static bool locale_is_utf8(void) {
    static const char *const names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *locale = getenv(names[i]);
        if (locale && locale[0] != '\0') {
            const char *encoding = strchr(locale, '.');
            return encoding && (strncasecmp(encoding, ".UTF-8", 6) == 0 || strncasecmp(encoding, ".utf8", 5) == 0);
        }
    }
    return false;
}

static ChafaCanvasMode colours_of(const ChafaTermInfo *terminal, bool colour) {
    static const struct {
        ChafaTermSeq sequence;
        ChafaCanvasMode mode;
    } modes[] = {
        {CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT, CHAFA_CANVAS_MODE_TRUECOLOR},
        {CHAFA_TERM_SEQ_SET_COLOR_FGBG_256, CHAFA_CANVAS_MODE_INDEXED_240},
        {CHAFA_TERM_SEQ_SET_COLOR_FGBG_16, CHAFA_CANVAS_MODE_INDEXED_16},
        {CHAFA_TERM_SEQ_SET_COLOR_FGBG_8, CHAFA_CANVAS_MODE_INDEXED_8},
        {CHAFA_TERM_SEQ_INVERT_COLORS, CHAFA_CANVAS_MODE_FGBG_BGFG},
    };
    for (size_t i = colour ? 0 : 4; i < sizeof modes / sizeof modes[0]; i++)
        if (chafa_term_info_have_seq(terminal, modes[i].sequence))
            return modes[i].mode;
    return CHAFA_CANVAS_MODE_FGBG;
}

// Multiplexers such as tmux and screen do not pass on graphics, even if the environment names a terminal that supports
// them.
static ChafaPixelMode pixels_of(const ChafaTermInfo *terminal, bool colour) {
    const char *name = getenv("TERM");
    bool between = getenv("TMUX") || (name && strncmp(name, "screen", 6) == 0);
    if (!colour || between)
        return CHAFA_PIXEL_MODE_SYMBOLS;
    if (chafa_term_info_have_seq(terminal, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1))
        return CHAFA_PIXEL_MODE_KITTY;
    return chafa_term_info_have_seq(terminal, CHAFA_TERM_SEQ_BEGIN_SIXELS) ? CHAFA_PIXEL_MODE_SIXELS
                                                                           : CHAFA_PIXEL_MODE_SYMBOLS;
}

TerminalPicture *terminal_picture_new(int fd, bool colour) {
    TerminalPicture *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return NULL;
    gchar **environment = g_get_environ();
    renderer->fd = fd;
    renderer->terminal = chafa_term_db_detect(chafa_term_db_get_default(), environment);
    g_strfreev(environment);
    renderer->colours = colours_of(renderer->terminal, colour);
    renderer->pixels = pixels_of(renderer->terminal, colour);
    renderer->symbols = chafa_symbol_map_new();
    chafa_symbol_map_add_by_tags(renderer->symbols, locale_is_utf8() ? CHAFA_SYMBOL_TAG_SPACE | CHAFA_SYMBOL_TAG_BLOCK
                                                                     : CHAFA_SYMBOL_TAG_SPACE | CHAFA_SYMBOL_TAG_ASCII);
    return renderer;
}

void terminal_picture_free(TerminalPicture *renderer) {
    if (!renderer)
        return;
    chafa_term_info_unref(renderer->terminal);
    chafa_symbol_map_unref(renderer->symbols);
    free(renderer);
}

bool terminal_picture_is_graphics(const TerminalPicture *renderer) {
    return renderer->pixels != CHAFA_PIXEL_MODE_SYMBOLS;
}

// Returns the size of a cell in pixels, which may be fractional because terminals have margins.
static void cell_size(const TerminalPicture *renderer, double *width, double *height) {
    OsTerminalSize size;
    *width = CELL_WIDTH;
    *height = CELL_HEIGHT;
    if (os_terminal_size(renderer->fd, &size) && size.columns > 0 && size.rows > 0 && size.width > size.columns &&
        size.height > size.rows) {
        *width = (double)size.width / size.columns;
        *height = (double)size.height / size.rows;
    }
}

static int clamp_size(double x, int max) {
    return x < 1 ? 1 : x > max ? max : (int)x;
}

TerminalCells terminal_picture_fit(const TerminalPicture *renderer, int columns, int rows, int width, int height) {
    double cell_width, cell_height;
    cell_size(renderer, &cell_width, &cell_height);
    double across = (double)columns * cell_width / width, down = (double)rows * cell_height / height;
    double scale = across < down ? across : down;
    TerminalCells cells = {.columns = clamp_size(width * scale / cell_width + 0.5, columns),
                           .rows = clamp_size(height * scale / cell_height + 0.5, rows)};
    bool graphics = terminal_picture_is_graphics(renderer);
    cells.width = cells.columns * (graphics ? (int)cell_width : DRAWN_WIDTH);
    cells.height = cells.rows * (graphics ? (int)cell_height : DRAWN_HEIGHT);
    return cells;
}

static ChafaCanvas *new_canvas(const TerminalPicture *renderer, const TerminalCells *cells) {
    double cell_width, cell_height;
    cell_size(renderer, &cell_width, &cell_height);
    ChafaCanvasConfig *config = chafa_canvas_config_new();
    chafa_canvas_config_set_geometry(config, cells->columns, cells->rows);
    chafa_canvas_config_set_cell_geometry(config, (int)cell_width, (int)cell_height);
    chafa_canvas_config_set_canvas_mode(config, renderer->colours);
    chafa_canvas_config_set_pixel_mode(config, renderer->pixels);
    chafa_canvas_config_set_symbol_map(config, renderer->symbols);
    ChafaCanvas *canvas = chafa_canvas_new(config);
    chafa_canvas_config_unref(config);
    return canvas;
}

char *terminal_picture_text(TerminalPicture *renderer, const uint32_t *pixels, const TerminalCells *cells,
                            size_t *length) {
    const bool little_endian = *(const uint8_t *)&(const uint32_t){1} == 1;
    ChafaCanvas *canvas = new_canvas(renderer, cells);
    chafa_canvas_draw_all_pixels(canvas,
                                 little_endian ? CHAFA_PIXEL_BGRA8_PREMULTIPLIED : CHAFA_PIXEL_ARGB8_PREMULTIPLIED,
                                 (const guint8 *)pixels, cells->width, cells->height, cells->width * 4);
    GString *text = chafa_canvas_print(canvas, renderer->terminal);
    chafa_canvas_unref(canvas);
    char *copy = malloc(text->len + 1);
    if (copy) {
        memcpy(copy, text->str, text->len + 1);
        *length = text->len;
    }
    g_string_free(text, TRUE);
    return copy;
}
#else
bool terminal_picture_possible(void) {
    return false;
}

TerminalPicture *terminal_picture_new(int fd, bool colour) {
    (void)fd;
    (void)colour;
    return NULL;
}

void terminal_picture_free(TerminalPicture *renderer) {
    (void)renderer;
}

bool terminal_picture_is_graphics(const TerminalPicture *renderer) {
    (void)renderer;
    return false;
}

TerminalCells terminal_picture_fit(const TerminalPicture *renderer, int columns, int rows, int width, int height) {
    (void)renderer;
    return (TerminalCells){columns, rows, width, height};
}

char *terminal_picture_text(TerminalPicture *renderer, const uint32_t *pixels, const TerminalCells *cells,
                            size_t *length) {
    (void)renderer;
    (void)pixels;
    (void)cells;
    *length = 0;
    return NULL;
}
#endif

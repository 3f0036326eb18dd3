// terminal_view.c: the terminal display. libchafa converts pictures; keys and mouse events arrive as escape sequences.
//
// While the display is open, the terminal uses its alternate screen, reports single keys and the mouse, and hides the
// cursor. The terminal is restored when the process ends, except after SIGKILL.
#include "base/file.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/progress.h"
#include "view/display.h"
#include "view/terminal_keys.h"
#include "view/terminal_picture.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

enum { DEFAULT_COLUMNS = 80, DEFAULT_ROWS = 24 };

// ENTER selects the alternate screen, hides the cursor, enables mouse and focus reports, and saves the title. LEAVE
// reverses this.
static const char ENTER[] = "\033[?1049h\033[?25l\033[?1003h\033[?1006h\033[?1004h\033[22;0t\033[2J";
static const char LEAVE[] = "\033[0m\033[?1004l\033[?1006l\033[?1003l\033[?25h\033[23;0t\033[?1049l";
// Kitty images must be deleted separately.
static const char DELETE_IMAGES[] = "\033_Ga=d,q=2\033\\";
// Terminals that support synchronized output show the output between these two sequences at once.
static const char BEGIN_UPDATE[] = "\033[?2026h", END_UPDATE[] = "\033[?2026l";

struct Display {
    TerminalPicture *renderer;
    TerminalInput input;
    TerminalCells cells; // size of the last picture
    int columns;         // size of the terminal
    int rows;
    int left; // number of columns to the left of the picture
    int top;  // number of rows above the picture
    Overlay shown;
    char title[200];
    bool colour;
    bool clear; // true if the whole screen must be drawn again
};

// Global, because signal handlers and atexit functions have no other access.
static struct {
    pthread_t owner;               // the thread that draws
    volatile sig_atomic_t entered; // true while the terminal must be restored
    volatile sig_atomic_t resized;
    volatile sig_atomic_t suspended;
    bool has_settings;
    struct termios settings;
} terminal;

// Restores the terminal. Safe in signal handlers.
static void restore_terminal(void) {
    if (terminal.entered) {
        terminal.entered = 0;
        file_write(STDOUT_FILENO, LEAVE, sizeof LEAVE - 1);
        if (terminal.has_settings)
            tcsetattr(STDIN_FILENO, TCSAFLUSH, &terminal.settings);
    }
}

// An external signal may arrive in any thread. It is forwarded to the drawing thread, which must not draw after the
// terminal is restored.
static void on_crash(int number, siginfo_t *info, void *context) {
    (void)context;
    if ((info->si_code == SI_USER || number == SIGQUIT) && !pthread_equal(pthread_self(), terminal.owner)) {
        pthread_kill(terminal.owner, number);
        return;
    }
    restore_terminal();
    signal(number, SIG_DFL);
    raise(number);
}

static void on_resize(int number) {
    (void)number;
    terminal.resized = 1;
}

static void on_suspend(int number) {
    (void)number;
    terminal.suspended = 1;
}

static void catch_signals(void) {
    struct sigaction action = {.sa_sigaction = on_crash, .sa_flags = SA_SIGINFO};
    sigemptyset(&action.sa_mask);
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGQUIT};
    for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++)
        sigaction(crashes[i], &action, NULL);
    signal_catch(SIGWINCH, on_resize, 0);
    signal_catch(SIGTSTP, on_suspend, 0);
}

static void enter_terminal(void) {
    if (terminal.has_settings) {
        struct termios raw = terminal.settings;
        raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO | IEXTEN); // Ctrl-C and Ctrl-Z still send signals
        raw.c_iflag &= ~(tcflag_t)(IXON | ICRNL);
        raw.c_cc[VMIN] = 0;
        raw.c_cc[VTIME] = 0;
        tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw);
    }
    terminal.entered = 1;
    file_write(STDOUT_FILENO, ENTER, sizeof ENTER - 1);
}

static void measure_terminal(Display *display) {
    display->columns = DEFAULT_COLUMNS;
    display->rows = DEFAULT_ROWS;
    terminal_extent(STDOUT_FILENO, &display->columns, &display->rows);
}

static void terminal_set_title(Display *display, const char *title) {
    overlay_set(display->title, sizeof display->title, title);
    SCOPED_TEXT text = {0};
    text_add_format(&text, "\033]0;%s\033\\", display->title);
    file_write(STDOUT_FILENO, text.bytes, text.len);
}

static void terminal_close(Display *display) {
    if (!display)
        return;
    if (terminal.entered && terminal_picture_is_graphics(display->renderer))
        file_write(STDOUT_FILENO, DELETE_IMAGES, sizeof DELETE_IMAGES - 1);
    restore_terminal();
    terminal_picture_free(display->renderer);
    free(display);
}

static Display *terminal_open(const char *title, int width, int height, PetriPainter *painter, bool colour) {
    (void)painter;
    (void)width;
    (void)height;
    if (!isatty(STDOUT_FILENO)) {
        message("no display, and standard output is not a terminal");
        return NULL;
    }
    Display *display = memory_calloc(sizeof *display);
    display->renderer = terminal_picture_new(STDOUT_FILENO, colour);
    display->colour = colour;
    display->clear = true;
    if (!display->renderer) {
        message("out of memory");
        terminal_close(display);
        return NULL;
    }
    terminal.has_settings = isatty(STDIN_FILENO) && tcgetattr(STDIN_FILENO, &terminal.settings) == 0;
    display->input.closed = !terminal.has_settings; // keys are only read from terminals
    terminal.owner = pthread_self();
    atexit(restore_terminal);
    catch_signals();
    measure_terminal(display);
    enter_terminal();
    terminal_set_title(display, title);
    return display;
}

// On Ctrl-Z, restores the terminal for the shell until the process is continued.
static void suspend_process(Display *display) {
    terminal.suspended = 0;
    restore_terminal();
    raise(SIGSTOP);
    measure_terminal(display);
    enter_terminal();
    terminal_set_title(display, display->title);
    display->clear = true;
}

static Event to_pixels(const Display *display, Event event) {
    if (event.kind == EVENT_POINTER && event.inside) {
        event.x = (event.x - display->left) * display->cells.width / (display->cells.columns + 1e-9);
        event.y = (event.y - display->top) * display->cells.height / (display->cells.rows + 1e-9);
    }
    return event;
}

static void wait_for_input(Display *display, double seconds) {
    struct pollfd input = {.fd = display->input.closed ? -1 : STDIN_FILENO, .events = POLLIN};
    if (poll(&input, 1, (int)(seconds * 1000)) > 0)
        terminal_input_read(&display->input, STDIN_FILENO);
}

static Event terminal_next_event(Display *display, double seconds) {
    if (terminal.suspended)
        suspend_process(display);
    Event event = terminal_input_next(&display->input);
    if (event.kind == EVENT_NONE) {
        wait_for_input(display, seconds);
        event = terminal_input_next(&display->input);
    }
    if (event.kind == EVENT_NONE && (terminal.resized || display->clear)) {
        terminal.resized = 0;
        measure_terminal(display);
        display->clear = true;
        return (Event){.kind = EVENT_REDRAW};
    }
    return to_pixels(display, event);
}

static void terminal_size(Display *display, int width, int height, int *drawn_width, int *drawn_height) {
    TerminalCells cells = terminal_picture_fit(display->renderer, display->columns, display->rows, width, height);
    display->clear = display->clear || cells.columns != display->cells.columns || cells.rows != display->cells.rows;
    display->cells = cells;
    display->left = (display->columns - cells.columns) / 2;
    display->top = (display->rows - cells.rows) / 2;
    *drawn_width = cells.width;
    *drawn_height = cells.height;
}

static bool terminal_coarse(const Display *display) {
    return !terminal_picture_is_graphics(display->renderer);
}

// Writes the lines of a text over the full width, starting at `row`. `look` is an escape sequence for the style.
static void add_lines(Text *out, const char *text, int row, const Display *display, const char *look) {
    for (const char *line = text; line && *text != '\0' && row < display->rows; row++) {
        text_add_format(out, "\033[%d;1H%s %.*s\033[K\033[0m", row + 1, look, (int)strcspn(line, "\n"), line);
        const char *end = strchr(line, '\n');
        line = !end ? NULL : end + 1;
    }
}

// Adds the errors at the top, the mark at the top right, and the other texts at the bottom.
static void add_overlay(Text *out, const Display *display, const Overlay *overlay) {
    static const char reverse[] = "\033[7m", careful[] = "\033[38;5;230;48;5;58m";
    char text[sizeof *overlay];
    int columns = display->columns - 2, row = display->rows;
    overlay_fit(text, sizeof text, overlay->error_text, columns);
    const char *wrong = overlay->is_warning ? careful : "\033[38;5;224;48;5;52m";
    add_lines(out, text, 0, display, display->colour ? wrong : reverse);
    int length = overlay_columns(overlay->mark);
    if (length > 0 && length + 2 <= display->columns) {
        text_add_format(out, "\033[1;%dH%s %s \033[0m", display->columns - length - 1,
                        display->colour ? careful : reverse, overlay->mark);
    }
    overlay_fit(text, sizeof text, overlay->status, columns);
    row -= overlay_lines(text);
    add_lines(out, text, row < 0 ? 0 : row, display, display->colour ? "\033[38;5;253;48;5;234m" : reverse);
    overlay_fit(text, sizeof text, overlay->notice, columns);
    row -= overlay_lines(text);
    add_lines(out, text, row < 0 ? 0 : row, display, display->colour ? "\033[38;5;153;48;5;234m" : reverse);
}

static void add_picture(Text *out, const Display *display, const char *text, size_t length) {
    int row = display->top;
    for (const char *end = text + length; text < end; row++) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        size_t part = (size_t)((!newline ? end : newline) - text);
        text_add_format(out, "\033[%d;%dH", row + 1, display->left + 1);
        text_add(out, (Str){text, part});
        text += part + 1;
    }
}

static bool same_lines(const Overlay *a, const Overlay *b) {
    return overlay_lines(a->error_text) == overlay_lines(b->error_text) &&
           overlay_lines(a->notice) == overlay_lines(b->notice) &&
           overlay_lines(a->status) == overlay_lines(b->status) && strcmp(a->mark, b->mark) == 0;
}

static bool terminal_show(Display *display, uint32_t *pixels, int width, int height, const Overlay *overlay) {
    (void)width; // `size` has determined the width
    (void)height;
    size_t length = 0;
    char *text = terminal_picture_text(display->renderer, pixels, &display->cells, &length);
    if (!text) {
        message("out of memory");
        return false;
    }
    SCOPED_TEXT out = {0};
    text_add_c(&out, BEGIN_UPDATE);
    // Fills the space around the picture with black, as in a window.
    if (display->clear || !same_lines(overlay, &display->shown))
        text_add_format(&out, "\033[0%sm\033[2J", display->colour ? ";40" : "");
    if (terminal_picture_is_graphics(display->renderer))
        text_add_c(&out, DELETE_IMAGES);
    add_picture(&out, display, text, length);
    add_overlay(&out, display, overlay);
    text_add_format(&out, "\033[0m%s", END_UPDATE);
    file_write(STDOUT_FILENO, out.bytes, out.len);
    free(text);
    display->shown = *overlay;
    display->clear = false;
    return true;
}

static const DisplayKind TERMINAL = {
    .open = terminal_open,
    .close = terminal_close,
    .next_event = terminal_next_event,
    .size = terminal_size,
    .coarse = terminal_coarse,
    .show = terminal_show,
    .set_title = terminal_set_title,
    .min_seconds = 1.0 / 30,
    .logs = false,
};

const DisplayKind *terminal_display(void) {
    return terminal_picture_possible() ? &TERMINAL : NULL;
}

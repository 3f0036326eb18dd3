// repl_edit.c: see repl_edit.h.
#include "repl_edit.h"

#ifdef HAVE_LIBEDIT

#include <errno.h>
#include <histedit.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>
#include <wchar.h>

#include "repl_complete.h"
#include "repl_plain.h"
#include "repl_saved.h"

struct Editor {
    Repl *repl;
    EditLine *line;
    History *history;
    char prompt[64];
};

// The terminal as it was: a signal handler can reach nothing but globals.
static struct termios settings;

// While a line is edited the terminal does not echo: it must not stay like that when a signal ends petri.
static void on_end(int signal_number) {
    tcsetattr(STDIN_FILENO, TCSANOW, &settings);
    raise(signal_number); // now without a handler
}

static void catch_ends(void) {
    static const int numbers[] = {SIGTERM, SIGHUP};
    struct sigaction action = {.sa_handler = on_end, .sa_flags = (int)SA_RESETHAND}, before;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && tcgetattr(STDIN_FILENO, &settings) == 0; i++) {
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN) { // as with nohup
            sigaction(numbers[i], &action, NULL);
        }
    }
}

static const char *prompt_of(EditLine *line) {
    Editor *editor = NULL;
    el_get(line, EL_CLIENTDATA, &editor);
    return editor->prompt;
}

// One character. Waits where changed files are noticed and where Ctrl-C ends it.
static int read_character(EditLine *line, wchar_t *character) {
    Editor *editor = NULL;
    el_get(line, EL_CLIENTDATA, &editor);
    mbstate_t state = {0};
    for (;;) {
        char byte;
        PlainWait wait = plain_wait(editor->repl);
        if (wait == WAIT_INTERRUPTED) {
            errno = EINTR;
            return -1;
        }
        if (wait == WAIT_NOTICED) {
            el_set(line, EL_REFRESH);
            continue;
        }
        ssize_t got = read(STDIN_FILENO, &byte, 1);
        if (got < 0 && errno == EINTR && !repl_interrupted()) {
            continue;
        }
        if (got <= 0) {
            return (int)got;
        }
        size_t used = mbrtowc(character, &byte, 1, &state);
        if (used == (size_t)-1) { // no character of this locale: left out
            state = (mbstate_t){0};
        } else if (used != (size_t)-2) {
            return 1;
        }
    }
}

static unsigned char complete(EditLine *line, wint_t character) {
    (void)character;
    Editor *editor = NULL;
    el_get(line, EL_CLIENTDATA, &editor);
    const LineInfo *info = el_line(line);
    Completion completion;
    complete_line(editor->repl, info->buffer, (size_t)(info->cursor - info->buffer), &completion);
    bool inserted = completion.common.length > 0 && el_insertstr(line, completion.common.data) == 0;
    unsigned char result = inserted ? CC_REFRESH : CC_ERROR;
    if (!inserted && completion.count > 1) {
        output_write(&editor->repl->output, "\n", 1);
        complete_show(&completion, &editor->repl->output);
        output_flush(&editor->repl->output);
        result = CC_REDISPLAY;
    }
    complete_free(&completion);
    return result;
}

static void load_history(Editor *editor) {
    HistEvent event;
    Bytes lines = {0};
    saved_read(&lines);
    for (size_t at = 0; at < lines.length;) {
        char *end = memchr(lines.data + at, '\n', lines.length - at);
        *end = '\0';
        history(editor->history, &event, H_ENTER, lines.data + at);
        at = (size_t)(end - lines.data) + 1;
    }
    bytes_free(&lines);
}

Editor *editor_new(Repl *repl) {
    const char *terminal = getenv("TERM");
    if (terminal == NULL || strcmp(terminal, "dumb") == 0) {
        return NULL;
    }
    catch_ends(); // before libedit changes the terminal
    Editor *editor = memory_zeroed(sizeof *editor);
    HistEvent event;
    editor->repl = repl;
    editor->line = el_init("petri", stdin, stdout, stderr);
    editor->history = history_init();
    if (editor->line == NULL || editor->history == NULL) {
        editor_free(editor);
        return NULL;
    }
    history(editor->history, &event, H_SETSIZE, SAVED_MOST);
    history(editor->history, &event, H_SETUNIQUE, 1);
    load_history(editor);
    el_set(editor->line, EL_CLIENTDATA, editor);
    el_set(editor->line, EL_PROMPT_ESC, prompt_of, '\1');
    el_set(editor->line, EL_EDITOR, "emacs");
    el_set(editor->line, EL_HIST, history, editor->history);
    // libedit copies narrow names and never frees the copies.
    el_wset(editor->line, EL_ADDFN, L"petri-complete", L"complete the word", complete);
    el_set(editor->line, EL_BIND, "^I", "petri-complete", NULL);
    el_set(editor->line, EL_BIND, "^R", "em-inc-search-prev", NULL);
    el_set(editor->line, EL_BIND, "^W", "ed-delete-prev-word", NULL);
    el_set(editor->line, EL_GETCFN, read_character);
    el_source(editor->line, NULL);
    return editor;
}

void editor_free(Editor *editor) {
    if (editor == NULL) {
        return;
    }
    if (editor->history != NULL) {
        history_end(editor->history);
    }
    if (editor->line != NULL) {
        el_end(editor->line);
    }
    free(editor);
}

static void remember(Editor *editor, const Bytes *line) {
    HistEvent event;
    enum { LONGEST = 10000 };
    if (line->length == 0 || line->length > LONGEST) {
        return;
    }
    history(editor->history, &event, H_ENTER, line->data);
    Bytes whole = {0};
    bytes_add(&whole, line->data, line->length);
    bytes_add(&whole, "\n", 1);
    saved_add(&whole); // at once: a terminal that is closed ends petri without a word
    bytes_free(&whole);
}

LineStatus editor_read(Editor *editor, const char *prompt, Bytes *line) {
    bool coloured = editor->repl->colour;
    snprintf(editor->prompt, sizeof editor->prompt, coloured ? "\1\033[1;32m\1%s\1\033[0m\1" : "%s", prompt);
    int count = 0;
    bytes_add(line, "", 0);
    const char *text = el_gets(editor->line, &count);
    if (text == NULL || count <= 0) {
        bool stopped = repl_interrupted();
        if (stopped) {
            el_reset(editor->line);
        }
        output_write(&editor->repl->output, stopped ? "^C\n" : "\n", stopped ? 3 : 1);
        output_flush(&editor->repl->output);
        return stopped ? LINE_INTERRUPTED : LINE_END;
    }
    size_t length = (size_t)count;
    bytes_add(line, text, text[length - 1] == '\n' ? length - 1 : length);
    remember(editor, line);
    return LINE_READ;
}

#else

#include <stddef.h>

Editor *editor_new(Repl *repl) {
    repl_say(repl, "built without libedit: lines cannot be edited, completed or recalled");
    return NULL;
}

void editor_free(Editor *editor) {
    (void)editor;
}

LineStatus editor_read(Editor *editor, const char *prompt, Bytes *line) {
    (void)editor;
    (void)prompt;
    (void)line;
    return LINE_END;
}

#endif

// edit.c: the line editor, which uses libedit, with history and completion.
#include "repl/line.h"

#ifdef HAVE_LIBEDIT

#include "base/str.h"
#include "cli/progress.h"

#include <errno.h>
#include <histedit.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>
#include <wchar.h>

struct Editor {
    Repl *repl;
    EditLine *line;
    History *history;
    char prompt[64];
    unsigned back; // number of the shown history entry, counted from 1, the newest; 0: the block being typed
};

// Terminal settings before editing. Global, because the signal handler needs them.
static struct termios settings;

// Restores the terminal, which does not echo during editing, when a signal terminates petri.
static void on_termination(int signal_number) {
    tcsetattr(STDIN_FILENO, TCSANOW, &settings);
    raise(signal_number); // because of SA_RESETHAND, this takes the default action
}

static void catch_termination(void) {
    if (tcgetattr(STDIN_FILENO, &settings) == 0) {
        signal_catch(SIGTERM, on_termination, (int)SA_RESETHAND);
        signal_catch(SIGHUP, on_termination, (int)SA_RESETHAND);
    }
}

static Editor *editor_of(EditLine *line) {
    Editor *editor = NULL;
    el_get(line, EL_CLIENTDATA, &editor);
    return editor;
}

static const char *prompt_of(EditLine *line) {
    return editor_of(line)->prompt;
}

// Moves the cursor below the block, where output can follow. Can leave one empty line if lines wrap.
static void leave_block(Editor *editor) {
    const LineInfo *info = el_line(editor->line);
    int width = 80, height = 0, column = 0;
    terminal_extent(STDOUT_FILENO, &width, &height);
    for (const char *c = info->cursor; c < info->lastchar; c++) {
        column = *c == '\n' ? 0 : column + 1;
        output_write(&editor->repl->output, "\n", *c == '\n' || column == width);
    }
}

// Reads one character for libedit. While waiting, reports changed files and returns -1 on Ctrl-C.
static int read_character(EditLine *line, wchar_t *character) {
    Editor *editor = editor_of(line);
    mbstate_t state = {0};
    for (;;) {
        char byte;
        LineWait wait = line_wait(editor->repl);
        if (wait == WAIT_INTERRUPTED) {
            leave_block(editor);
            errno = EINTR;
            return -1;
        }
        if (wait == WAIT_NOTICED) {
            el_set(line, EL_REFRESH);
            continue;
        }
        ssize_t got = read(STDIN_FILENO, &byte, 1);
        if (got < 0 && errno == EINTR && !repl_interrupted())
            continue;
        if (got <= 0)
            return (int)got;
        size_t used = mbrtowc(character, &byte, 1, &state);
        if (used == (size_t)-1) // skip bytes that are not a character in this locale
            state = (mbstate_t){0};
        else if (used != (size_t)-2)
            return 1;
    }
}

// Returns the start of the line that the cursor is in.
static const char *line_start(const LineInfo *info) {
    const char *start = info->cursor;
    while (start > info->buffer && start[-1] != '\n')
        start--;
    return start;
}

// Keys bound to libedit's built-in functions. petri's functions call a built-in function by pushing its key into the
// input.
#define KEY_ACCEPT "\036"        // Ctrl-^
#define KEY_LINE_UP "\030\020"   // Ctrl-X Ctrl-P
#define KEY_LINE_DOWN "\030\016" // Ctrl-X Ctrl-N
#define KEY_HISTORY_UP "\020"
#define KEY_HISTORY_DOWN "\016"

static unsigned char push_keys(EditLine *line, const char *keys) {
    el_push(line, keys);
    return CC_NORM;
}

// Enter: accepts the block if it is complete, else appends a line feed.
static unsigned char handle_enter(EditLine *line, wint_t character) {
    (void)character;
    Editor *editor = editor_of(line);
    const LineInfo *info = el_line(line);
    SCOPED_TEXT text = {0};
    size_t consumed = 0;
    text_add(&text, (Str){info->buffer, (size_t)(info->lastchar - info->buffer)});
    text_add_c(&text, "\n");
    bool more = line_needs_more(editor->repl, text.bytes, text.len, &consumed);
    el_cursor(line, (int)text.len); // moves the cursor to the end, because libedit stops there
    if (!more)
        return push_keys(line, KEY_ACCEPT);
    // Pasted lines have their own indentation; the rest of them waits.
    struct pollfd input = {STDIN_FILENO, POLLIN, 0};
    size_t blanks = poll(&input, 1, 0) > 0 ? 0 : line_indentation(editor->repl, text.bytes, text.len);
    SCOPED_TEXT next = {0};
    text_add_format(&next, "\n%*s", (int)blanks, "");
    return el_insertstr(line, next.bytes) == 0 ? CC_REFRESH : CC_ERROR;
}

// Alt-Enter: inserts a line feed at the cursor.
static unsigned char open_line(EditLine *line, wint_t character) {
    (void)character;
    return el_insertstr(line, "\n") == 0 ? CC_REFRESH : CC_ERROR;
}

static unsigned char go_up(EditLine *line, wint_t character) {
    (void)character;
    Editor *editor = editor_of(line);
    const LineInfo *info = el_line(line);
    bool inside = line_start(info) > info->buffer;
    editor->back += !inside;
    return push_keys(line, inside ? KEY_LINE_UP : KEY_HISTORY_UP);
}

// Down: goes to the next line of the block or, from the last line, to the next history entry. In the last line of the
// block being typed, does nothing, because libedit would clear the line.
static unsigned char go_down(EditLine *line, wint_t character) {
    (void)character;
    Editor *editor = editor_of(line);
    const LineInfo *info = el_line(line);
    if (memchr(info->cursor, '\n', (size_t)(info->lastchar - info->cursor)))
        return push_keys(line, KEY_LINE_DOWN);
    if (editor->back == 0)
        return CC_ERROR;
    editor->back--;
    return push_keys(line, KEY_HISTORY_DOWN);
}

// Returns the number of characters, not bytes, between two positions.
static int count_characters(const char *from, const char *to) {
    return (int)utf8_length((Str){from, (size_t)(to - from)});
}

static unsigned char go_home(EditLine *line, wint_t character) {
    (void)character;
    const LineInfo *info = el_line(line);
    el_cursor(line, -count_characters(line_start(info), info->cursor));
    return CC_CURSOR;
}

// Moves the cursor to the end of the line. Returns the number of characters moved.
static int to_line_end(EditLine *line) {
    const LineInfo *info = el_line(line);
    const char *end = info->cursor;
    while (end < info->lastchar && *end != '\n')
        end++;
    int count = count_characters(info->cursor, end);
    el_cursor(line, count);
    return count;
}

static unsigned char go_end(EditLine *line, wint_t character) {
    (void)character;
    to_line_end(line);
    return CC_CURSOR;
}

// Deletes the rest of the line, or the line feed if the cursor is at the end of the line.
static unsigned char kill_rest(EditLine *line, wint_t character) {
    (void)character;
    int count = to_line_end(line);
    const LineInfo *info = el_line(line);
    if (count == 0 && info->cursor < info->lastchar) {
        el_cursor(line, 1);
        count = 1;
    }
    el_deletestr(line, count);
    return CC_REFRESH;
}

static unsigned char complete_word(EditLine *line, wint_t character) {
    (void)character;
    Editor *editor = editor_of(line);
    const LineInfo *info = el_line(line);
    const char *start = line_start(info);
    if (start > info->buffer && strspn(start, " \t") >= (size_t)(info->cursor - start))
        return el_insertstr(line, "    ") == 0 ? CC_REFRESH : CC_ERROR; // no word before the cursor: indent
    Completion completion;
    complete_line(&editor->repl->prompt, start, (size_t)(info->cursor - start), &completion);
    bool inserted = completion.common.len > 0 && el_insertstr(line, completion.common.bytes) == 0;
    unsigned char result = inserted ? CC_REFRESH : CC_ERROR;
    if (!inserted && completion.words.count > 1) {
        leave_block(editor);
        output_write(&editor->repl->output, "\n", 1);
        complete_show(&completion, &editor->repl->output);
        output_flush(&editor->repl->output);
        result = CC_REDISPLAY;
    }
    complete_free(&completion);
    return result;
}

static void replace_character(char *text, char old, char new) {
    while ((text = strchr(text, old)))
        *text = new;
}

static void load_history(Editor *editor) {
    HistEvent event;
    SCOPED_TEXT lines = {0};
    saved_read(&lines);
    Str line;
    for (size_t at = 0; text_next_line(&lines, &at, &line);) {
        SCOPED_STRING block = memory_strndup(line.bytes, line.len);
        replace_character(block, SAVED_LINE_END, '\n');
        history(editor->history, &event, H_ENTER, block);
    }
}

// Uses wide names, because libedit copies narrow names and never frees the copies.
static void add_functions(EditLine *line) {
    el_wset(line, EL_ADDFN, L"petri-complete", L"complete the word", complete_word);
    el_wset(line, EL_ADDFN, L"petri-enter", L"run the lines, or begin another", handle_enter);
    el_wset(line, EL_ADDFN, L"petri-open-line", L"begin a line here", open_line);
    el_wset(line, EL_ADDFN, L"petri-home", L"go to the line's beginning", go_home);
    el_wset(line, EL_ADDFN, L"petri-end", L"go to the line's end", go_end);
    el_wset(line, EL_ADDFN, L"petri-kill-rest", L"delete the rest of the line", kill_rest);
    el_wset(line, EL_ADDFN, L"petri-up", L"go to the line above", go_up);
    el_wset(line, EL_ADDFN, L"petri-down", L"go to the line below", go_down);
}

static const struct {
    const char *key;
    const char *function;
} bindings[] = {
    // clang-format off
    {"^I", "petri-complete"},
    {"^R", "em-inc-search-prev"},
    {"^W", "ed-delete-prev-word"},
    {"^^", "ed-newline"},
    {"^X^P", "ed-prev-line"},
    {"^X^N", "ed-next-line"},
    {"^M", "petri-enter"}, {"^J", "petri-enter"},
    {"^[^M", "petri-open-line"}, {"^[^J", "petri-open-line"}, // Alt-Enter
    {"^A", "petri-home"}, {"^E", "petri-end"}, {"^K", "petri-kill-rest"},
    // Arrow keys, Home and End, as encoded by terminals in normal mode and in application mode.
    {"^[[A", "petri-up"}, {"^[OA", "petri-up"}, {"^[[B", "petri-down"}, {"^[OB", "petri-down"},
    {"^[[H", "petri-home"}, {"^[OH", "petri-home"}, {"^[[1~", "petri-home"},
    {"^[[F", "petri-end"}, {"^[OF", "petri-end"}, {"^[[4~", "petri-end"},
    // clang-format on
};

Editor *editor_new(Repl *repl) {
    const char *terminal = getenv("TERM");
    if (!terminal || strcmp(terminal, "dumb") == 0)
        return NULL;
    catch_termination(); // before libedit changes the terminal
    Editor *editor = memory_calloc(sizeof *editor);
    HistEvent event;
    editor->repl = repl;
    editor->line = el_init("petri", stdin, stdout, stderr);
    editor->history = history_init();
    if (!editor->line || !editor->history) {
        editor_free(editor);
        return NULL;
    }
    history(editor->history, &event, H_SETSIZE, SAVED_MAX);
    history(editor->history, &event, H_SETUNIQUE, 1);
    load_history(editor);
    el_set(editor->line, EL_CLIENTDATA, editor);
    el_set(editor->line, EL_PROMPT_ESC, prompt_of, '\1');
    el_set(editor->line, EL_EDITOR, "emacs");
    el_set(editor->line, EL_HIST, history, editor->history);
    add_functions(editor->line);
    for (size_t i = 0; i < sizeof bindings / sizeof bindings[0]; i++)
        el_set(editor->line, EL_BIND, bindings[i].key, bindings[i].function, NULL);
    el_set(editor->line, EL_GETCFN, read_character);
    el_source(editor->line, NULL);
    return editor;
}

void editor_free(Editor *editor) {
    if (!editor)
        return;
    if (editor->history)
        history_end(editor->history);
    if (editor->line)
        el_end(editor->line);
    free(editor);
}

// Adds a block to the history as one entry, without the blank line at its end.
static void add_to_history(Editor *editor, const Text *lines) {
    HistEvent event;
    enum { MAX_BLOCK_LENGTH = 10000 };
    size_t length = lines->len;
    while (length > 0 && strchr(" \n", lines->bytes[length - 1]))
        length--;
    if (length == 0 || length > MAX_BLOCK_LENGTH)
        return;
    SCOPED_STRING block = memory_strndup(lines->bytes, length);
    history(editor->history, &event, H_ENTER, block);
    replace_character(block, '\n', SAVED_LINE_END);
    SCOPED_TEXT whole = {0};
    text_add_format(&whole, "%s\n", block);
    saved_add(&whole); // save now, because closing the terminal kills petri
}

LineStatus editor_read(Editor *editor, const char *prompt, Text *lines) {
    bool coloured = editor->repl->options->colour;
    snprintf(editor->prompt, sizeof editor->prompt, coloured ? "\1\033[1;32m\1%s\1\033[0m\1" : "%s", prompt);
    int count = 0;
    editor->back = 0;
    text_add_c(lines, "");
    const char *text = el_gets(editor->line, &count);
    if (!text || count <= 0) {
        bool stopped = repl_interrupted();
        if (stopped)
            el_reset(editor->line);
        output_write(&editor->repl->output, stopped ? "^C\n" : "\n", stopped ? 3 : 1);
        output_flush(&editor->repl->output);
        return stopped ? LINE_INTERRUPTED : LINE_END;
    }
    text_add(lines, (Str){text, (size_t)count});
    if (lines->bytes[lines->len - 1] != '\n')
        text_add_c(lines, "\n");
    add_to_history(editor, lines);
    return LINE_READ;
}

#else

#include <stddef.h>

Editor *editor_new(Repl *repl) {
    prompt_note(&repl->prompt, "petri was built without libedit: lines cannot be edited, completed or recalled");
    return NULL;
}

void editor_free(Editor *editor) {
    (void)editor;
}

LineStatus editor_read(Editor *editor, const char *prompt, Text *line) {
    (void)editor;
    (void)prompt;
    (void)line;
    return LINE_END;
}

#endif

// terminal_keys.c: see terminal_keys.h.
//
// Bytes stay in the buffer until they form a complete sequence. An escape can be a key or the start of a sequence, so
// it counts as a key only after ESCAPE_SECONDS.
#include "view/terminal_keys.h"

#include "base/clock.h"
#include "petri-live.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Seconds after which an escape without further characters counts as the Escape key.
static const double ESCAPE_SECONDS = 0.05;

static const char letters[26][2] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m",
                                    "n", "o", "p", "q", "r", "s", "t", "u", "v", "w", "x", "y", "z"};
static const char digits[10][2] = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};

const char *key_of_character(char character) {
    static const struct {
        char character;
        const char *name;
    } signs[] = {
        {' ', "space"}, {'\'', "apostrophe"},   {',', "comma"},        {'-', "minus"},        {'.', "period"},
        {'/', "slash"}, {';', "semicolon"},     {'=', "equal"},        {'[', "left_bracket"}, {'\\', "backslash"},
        {'+', "equal"}, {']', "right_bracket"}, {'`', "grave_accent"}, {'\r', "enter"},       {'\n', "enter"},
        {'\t', "tab"},  {'\b', "backspace"},    {127, "backspace"},    {27, "escape"},
    };
    if (character >= 'a' && character <= 'z')
        return letters[character - 'a'];
    if (character >= 'A' && character <= 'Z')
        return letters[character - 'A'];
    if (character >= '0' && character <= '9')
        return digits[character - '0'];
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (signs[i].character == character)
            return signs[i].name;
    return NULL;
}

void terminal_input_read(TerminalInput *input, int fd) {
    size_t room = sizeof input->bytes - input->count;
    if (room == 0) { // the buffer is full, but no valid sequence is this long
        input->count = 0;
        room = sizeof input->bytes;
    }
    ssize_t count = read(fd, input->bytes + input->count, room);
    if (count > 0) {
        input->since = clock_seconds();
        input->count += (size_t)count;
    } else if (count == 0 || errno != EINTR) {
        input->closed = true;
    }
}

static void drop_bytes(TerminalInput *input, size_t count) {
    input->count -= count;
    memmove(input->bytes, input->bytes + count, input->count);
}

static Event key_tap_event(const char *key) {
    return (Event){.kind = !key ? EVENT_NONE : EVENT_KEY_TAP, .key = key};
}

static const char *key_of_letter(unsigned char letter) {
    static const char *const arrows[] = {"up", "down", "right", "left"};
    static const char *const functions[] = {"f1", "f2", "f3", "f4"};
    if (letter >= 'A' && letter <= 'D')
        return arrows[letter - 'A'];
    if (letter >= 'P' && letter <= 'S')
        return functions[letter - 'P'];
    return letter == 'H' ? "home" : letter == 'F' ? "end" : NULL;
}

static const char *key_of_number(long number) {
    static const char *const names[] = {
        NULL, "home", "insert", "delete", "end", "page_up", "page_down", "home", "end", NULL, NULL,  "f1",  "f2",
        "f3", "f4",   "f5",     NULL,     "f6",  "f7",      "f8",        "f9",   "f10", NULL, "f11", "f12",
    };
    return number > 0 && number < (long)(sizeof names / sizeof names[0]) ? names[number] : NULL;
}

// Decodes a mouse report `<code;column;row`, which ends in M (press, motion) or m (release).
static Event mouse_event(TerminalInput *input, const char *text, char last) {
    char *end;
    long code = strtol(text, &end, 10), column = *end == ';' ? strtol(end + 1, &end, 10) : 0,
         row = *end == ';' ? strtol(end + 1, &end, 10) : 0;
    static const unsigned buttons[] = {PETRI_BUTTON_LEFT, PETRI_BUTTON_MIDDLE, PETRI_BUTTON_RIGHT, 0};
    bool moved = (code & 32) != 0, wheel = (code & 64) != 0;
    if (column < 1 || row < 1 || wheel)
        return (Event){.kind = EVENT_NONE};
    if (!moved && last == 'M')
        input->buttons |= buttons[code & 3];
    else if (last == 'm')
        input->buttons &= ~buttons[code & 3];
    return (Event){.kind = EVENT_POINTER,
                   .inside = true,
                   .x = (double)column - 0.5,
                   .y = (double)row - 0.5,
                   .buttons = input->buttons};
}

// Decodes a sequence `ESC [ parameters last`.
static Event sequence_event(TerminalInput *input, const char *parameters, unsigned char last) {
    switch (last) {
    case 'M':
    case 'm':
        return parameters[0] == '<' ? mouse_event(input, parameters + 1, (char)last) : (Event){.kind = EVENT_NONE};
    case '~':
        return key_tap_event(key_of_number(strtol(parameters, NULL, 10)));
    case 'O':
        input->buttons = 0;
        return (Event){.kind = EVENT_FOCUS_LOST};
    default:
        return key_tap_event(key_of_letter(last));
    }
}

// Returns the length of the sequence that begins with ESC [, or 0 if it is incomplete.
static size_t sequence_length(const TerminalInput *input) {
    for (size_t i = 2; i < input->count; i++)
        if (input->bytes[i] >= '@' && input->bytes[i] <= '~')
            return i + 1;
    return 0;
}

static Event next_sequence(TerminalInput *input) {
    char parameters[sizeof input->bytes];
    size_t length = sequence_length(input);
    if (length == 0)
        return (Event){.kind = EVENT_NONE};
    memcpy(parameters, input->bytes + 2, length - 3);
    parameters[length - 3] = '\0';
    unsigned char last = input->bytes[length - 1];
    drop_bytes(input, length);
    return sequence_event(input, parameters, last);
}

static Event next_escape(TerminalInput *input) {
    bool late = clock_seconds() - input->since > ESCAPE_SECONDS;
    if (input->count == 1) {
        if (late)
            drop_bytes(input, 1);
        return late ? key_tap_event("escape") : (Event){.kind = EVENT_NONE};
    }
    if (input->bytes[1] == '[')
        return next_sequence(input);
    if (input->bytes[1] == 'O' && input->count > 2) {
        unsigned char letter = input->bytes[2];
        drop_bytes(input, 3);
        return key_tap_event(key_of_letter(letter));
    }
    if (input->bytes[1] == 'O' && !late)
        return (Event){.kind = EVENT_NONE};
    drop_bytes(input, 1); // the escape means Alt, unless another escape follows
    return input->bytes[0] == 27 ? key_tap_event("escape") : (Event){.kind = EVENT_NONE};
}

static Event next_character(TerminalInput *input) {
    unsigned char byte = input->bytes[0];
    drop_bytes(input, 1);
    if (byte >= 128) // part of a character for which no key has a name
        return (Event){.kind = EVENT_NONE};
    const char *key = key_of_character((char)byte);
    if (!key && byte > 0 && byte <= 26) {
        Event event = key_tap_event(key_of_character((char)('a' + byte - 1)));
        event.control = true;
        return event;
    }
    return key_tap_event(key);
}

Event terminal_input_next(TerminalInput *input) {
    Event event = {.kind = EVENT_NONE};
    for (size_t before = 0; input->count > 0 && event.kind == EVENT_NONE && before != input->count;) {
        before = input->count;
        event = input->bytes[0] == 27 ? next_escape(input) : next_character(input);
    }
    return event;
}

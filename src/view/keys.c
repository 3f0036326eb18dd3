// keys.c: see keys.h.
#include "view/keys.h"

#include <stddef.h>

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
    if (character >= 'a' && character <= 'z') {
        return letters[character - 'a'];
    }
    if (character >= 'A' && character <= 'Z') {
        return letters[character - 'A'];
    }
    if (character >= '0' && character <= '9') {
        return digits[character - '0'];
    }
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++) {
        if (signs[i].character == character) {
            return signs[i].name;
        }
    }
    return NULL;
}

// unicode.h: character classes for names and printing (spec language.md L2.4, L18.1).
#pragma once

#include <stdbool.h>
#include <stdint.h>

// Returns true if a name may start with this character: "_" or the Unicode property Alphabetic.
bool unicode_starts_name(uint32_t code_point);
// Returns true if a name may contain this character after the first: "_", Alphabetic, or a decimal digit.
bool unicode_continues_name(uint32_t code_point);
bool unicode_is_printable(uint32_t code_point);

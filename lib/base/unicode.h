// unicode.h: the classes of code points that names and printing need (spec language.md L2.4, L18.1).
#ifndef PETRI_BASE_UNICODE_H
#define PETRI_BASE_UNICODE_H

#include <stdbool.h>
#include <stdint.h>

// May a name start with it: "_" or the Unicode property Alphabetic.
bool unicode_starts_name(uint32_t code_point);
// May a name go on with it: the above or a decimal digit.
bool unicode_continues_name(uint32_t code_point);
bool unicode_is_printable(uint32_t code_point);

#endif

// display_list_rows.h: the rows of petri-display-list.inc for code that is made from them. Rows and operands whose
// macros are not defined are ignored.
// clang-format off
#ifndef COMMAND
#define COMMAND(name, operands)
#endif
#ifndef ELEMENT
#define ELEMENT(name, operands)
#endif
#ifndef FILTER_KIND
#define FILTER_KIND(name, operands)
#endif
#ifndef NUMBER
#define NUMBER(name)
#endif
#ifndef FLAG
#define FLAG(name) NUMBER(name)
#endif
#ifndef WORD
#define WORD(name, words) NUMBER(name)
#endif
#ifndef NUMBERS
#define NUMBERS(name, count)
#endif
#ifndef PAIR
#define PAIR(name) NUMBERS(name, 2)
#endif
#ifndef COLOUR
#define COLOUR(name)
#endif
#ifndef MATRIX
#define MATRIX(name)
#endif
#ifndef STOPS
#define STOPS(name)
#endif
#ifndef LIST
#define LIST(name)
#endif
#ifndef STRING
#define STRING(name)
#endif
#ifndef PATH
#define PATH(name)
#endif
#ifndef FILTER
#define FILTER(name)
#endif
#ifndef COMMANDS
#define COMMANDS(name)
#endif
#ifndef PIXELS
#define PIXELS(name)
#endif
#ifndef PAINT
#define PAINT(name)
#endif
#ifndef INPUT
#define INPUT(name)
#endif
#define PETRI_COMMAND(name, operands, text) COMMAND(name, operands)
#define PETRI_PATH_ELEMENT(name, operands, text) ELEMENT(name, operands)
#define PETRI_FILTER_KIND(name, operands, text) FILTER_KIND(name, operands)
#include "petri-display-list.inc"
#undef COMMAND
#undef ELEMENT
#undef FILTER_KIND
#undef NUMBER
#undef FLAG
#undef WORD
#undef NUMBERS
#undef PAIR
#undef COLOUR
#undef MATRIX
#undef STOPS
#undef LIST
#undef STRING
#undef PATH
#undef FILTER
#undef COMMANDS
#undef PIXELS
#undef PAINT
#undef INPUT

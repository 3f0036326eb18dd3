// display_list_macros.h: the rows of petri-display-list.inc, for code that is made from them. Each row is a ROW and one
// of the other kinds; those whose macros are not defined are ignored. In a ROW, the names of filters begin with
// FILTER_, those of effects with EFFECT_. If a macro uses operands, the includer defines NUMBER and the other types of
// operands, except those that have a definition here.
// clang-format off
#ifndef ROW
#define ROW(name, operands)
#endif
#ifndef COMMAND
#define COMMAND(name)
#endif
#ifndef ELEMENT
#define ELEMENT(name, operands)
#endif
#ifndef FILTER_KIND
#define FILTER_KIND(name)
#endif
#ifndef EFFECT_KIND
#define EFFECT_KIND(name)
#endif
#ifndef ALPHA
#define ALPHA(name) NUMBER(name)
#endif
#ifndef ROWS
#define ROWS(name) LIST(name)
#endif
#define FLAG(name) NUMBER(name)
#define WORD(name, words) NUMBER(name)
#define INPUTS(name) NUMBER(name)
#define INPUT(name)
#define PAIR(name) NUMBERS(name, 2)
#define PATH(name) LIST(name)
#define FILTER(name) ROWS(name)
#define EFFECT(name) ROWS(name)
#define COMMANDS(name) ROWS(name)
#define PETRI_COMMAND(name, operands, text) COMMAND(name) ROW(name, operands)
#define PETRI_PATH_ELEMENT(name, operands, text) ELEMENT(name, operands)
#define PETRI_FILTER_KIND(name, operands, text) FILTER_KIND(name) ROW(FILTER_##name, operands)
#define PETRI_EFFECT_KIND(name, operands, text) EFFECT_KIND(name) ROW(EFFECT_##name, operands)
#include "petri-display-list.inc"
#undef ROW
#undef COMMAND
#undef ELEMENT
#undef FILTER_KIND
#undef EFFECT_KIND
#undef ALPHA
#undef ROWS
#undef FLAG
#undef WORD
#undef INPUTS
#undef INPUT
#undef PAIR
#undef PATH
#undef FILTER
#undef EFFECT
#undef COMMANDS
#undef NUMBER
#undef NUMBERS
#undef COLOUR
#undef MATRIX
#undef STOPS
#undef LIST
#undef STRING
#undef PIXELS
#undef PAINT

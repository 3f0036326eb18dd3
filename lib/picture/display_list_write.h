// display_list_write.h: functions that write the rows of a display list, made from petri-display-list.inc.
//
// Operands that are lists of rows (FILTER, EFFECT, PAINT, COMMANDS, INPUT) come last. The caller writes them after the
// row, those with a length between display_list_open and display_list_close.
#pragma once

#include "picture/display_list.h"

static inline void display_list_add(DisplayList *list, const double *values, uint32_t count) {
    if (list->numbers.room - list->numbers.count < count) // checked here, because most calls add a single number
        list->numbers.at = display_list_grow(list->arena, list->numbers.at, list->numbers.count, &list->numbers.room,
                                             count, sizeof *values);
    double *to = list->numbers.at + list->numbers.count;
    list->numbers.count += count;
    for (uint32_t i = 0; i < count; i++)
        to[i] = values[i];
}

static inline void display_list_add_number(DisplayList *list, double number) {
    display_list_add(list, &number, 1);
}

static inline void display_list_add_list(DisplayList *list, DisplayNumbers numbers) {
    display_list_add_number(list, numbers.count);
    display_list_add(list, numbers.at, numbers.count);
}

// Numbers that are added between these calls are preceded by their count.
static inline uint32_t display_list_open(DisplayList *list) {
    display_list_add_number(list, 0);
    return list->numbers.count;
}

static inline void display_list_close(DisplayList *list, uint32_t start) {
    list->numbers.at[start - 1] = list->numbers.count - start;
}

// display_list.c
void display_list_add_string(DisplayList *list, Str text);
void display_list_add_pixels(DisplayList *list, Texture *texture);
// Notes a position in the script, and the id of a node, for the next number that is added.
void display_list_add_note(DisplayList *list, Origin place, Str id);

// Write a row and its operands.
#define ROW(name, operands)                                                                                            \
    static inline void display_list_write_##name(DisplayList *list, const name##Operands *o) {                         \
        display_list_add_number(list, o->kind);                                                                        \
        operands                                                                                                       \
    }
#define NUMBER(name) display_list_add_number(list, o->name);
#define NUMBERS(name, count) display_list_add(list, o->name, count);
#define MATRIX(name) display_list_add(list, &o->name->xx, 6);
#define COLOUR(name) display_list_add(list, o->name, 4);
#define STOPS(name)                                                                                                    \
    display_list_add_number(list, o->name.count);                                                                      \
    display_list_add(list, &o->name.at->offset, 5 * o->name.count);
#define LIST(name) display_list_add_list(list, o->name);
#define STRING(name) display_list_add_string(list, o->name.text);
#define PIXELS(name) display_list_add_pixels(list, o->name);
#define ROWS(name)
#define PAINT(name)
#include "picture/display_list_macros.h"

// DISPLAY_WRITE writes a command, DISPLAY_WRITE_ROW a row whose `kind` is set.
#define DISPLAY_WRITE_ROW(list, name, ...) display_list_write_##name(list, &(name##Operands){__VA_ARGS__})
#define DISPLAY_WRITE(list, name, ...) DISPLAY_WRITE_ROW(list, name, .kind = PETRI_DRAW_##name, __VA_ARGS__)

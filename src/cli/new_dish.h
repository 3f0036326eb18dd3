// new_dish.h: the lines of samples/dish.fl, which `petri new` writes. lines.sed generates new_dish.c from that script.
#ifndef PETRI_SRC_NEW_DISH_H
#define PETRI_SRC_NEW_DISH_H

// The lines, each with a newline at its end, then NULL.
extern const char *const NEW_DISH[];

#endif

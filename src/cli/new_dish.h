// new_dish.h: the lines of samples/dish.fl, which `petri new` writes; lines.sed makes new_dish.c of that script.
#ifndef PETRI_SRC_NEW_DISH_H
#define PETRI_SRC_NEW_DISH_H

// Ended by NULL; each line has its newline.
extern const char *const NEW_DISH[];

#endif

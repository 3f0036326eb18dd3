// new_dish.h: the lines of samples/dish.fl, which `petri new` writes. lines.sed generates new_dish.c from that script.
#pragma once

// The lines, each with a newline at its end, then NULL.
extern const char *const NEW_DISH[];

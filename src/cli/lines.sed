# Turns samples/dish.fl into new_dish.c: each line into a string of C.
1i #include "cli/new_dish.h"
1i #include <stddef.h>
1i const char *const NEW_DISH[] = {
s/[\\"]/\\&/g
s/.*/    "&\\n",/
$a NULL};

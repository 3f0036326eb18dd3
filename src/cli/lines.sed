# lines.sed: generates new_dish.c from samples/dish.fl; each line becomes a C string.
1i #include "cli/new_dish.h"
1i #include <stddef.h>
1i const char *const NEW_DISH[] = {
s/[\\"]/\\&/g
s/.*/    "&\\n",/
$a NULL};

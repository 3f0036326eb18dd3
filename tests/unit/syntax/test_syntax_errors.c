// test_syntax_errors.c: what syntax errors say: text, place and hint (cli.md 3.5).
#include "parsing.h"

int main(void) {
    return 0;
}

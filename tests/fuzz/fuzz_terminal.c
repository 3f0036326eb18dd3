// fuzz_terminal.c: fuzzes input from a terminal: keys, and reports of mouse and focus. The input is what the terminal
// sends.
#include "fuzz.h"
#include "view/terminal_keys.h"

#include <fcntl.h>
#include <math.h>
#include <unistd.h>

FUZZ_HARNESS(terminal) {
    TerminalInput input = {0};
    fuzz_put("typed", data, size);
    int file = open(fuzz_file("typed"), O_RDONLY);
    for (size_t i = 0; i < size + 2 && !input.closed; i++) {
        terminal_input_read(&input, file);
        for (Event event; (event = terminal_input_next(&input)).kind != EVENT_NONE;)
            if (isnan(event.x) || isnan(event.y))
                fuzz_fail("the position of an event is not a number");
    }
    close(file);
    return 0;
}

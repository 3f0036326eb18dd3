// show.c: .show, which shows the frame's picture in the terminal.
#include "repl/repl.h"
#include "view/still.h"
#include "view/terminal_picture.h"

enum { LINES_BELOW = 2 }; // terminal rows kept free for the prompt, below the picture

bool repl_run_show(Prompt *prompt, const char *rest) {
    Repl *repl = prompt->user_data;
    (void)rest;
    if (!terminal_picture_possible())
        return prompt_fail(prompt, "cannot show pictures in the terminal: petri was built without libchafa; on Debian, "
                                   "install libchafa-dev and build petri again");
    prompt_complete_frame(prompt);
    prompt_busy(prompt);
    PetriStatus status = petri_preview(prompt->session);
    if (status == PETRI_OK)
        status = still_show(prompt->session, NULL, repl->options->colour, LINES_BELOW, output_write, prompt->output);
    prompt_idle(prompt);
    return prompt_status(prompt, status);
}

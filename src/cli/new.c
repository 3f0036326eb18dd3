// new.c: the command `petri new`, which writes an example script to edit.
#include "base/file.h"
#include "base/replace.h"
#include "base/source.h"
#include "cli/memory.h"
#include "cli/new_dish.h"
#include "cli/options.h"
#include "cli/script.h"

#include <string.h>
#include <sys/stat.h>

// Writes the script to a file that must not exist yet. Returns the exit status.
static int write_dish(const char *path) {
    SCOPED_TEXT text = {0};
    for (size_t i = 0; NEW_DISH[i]; i++)
        text_add_c(&text, NEW_DISH[i]);
    const char *problem = file_replace(path, text_str(&text), REPLACE_CREATE_ONLY);
    struct stat info;
    if (problem && lstat(path, &info) == 0)
        message("%s already exists; choose another name", path);
    else if (problem)
        message("cannot write %s: %s", path, problem);
    return !problem ? STATUS_DONE : STATUS_FAILED;
}

// Creates NAME.fl. `name` may already end in .fl. Returns the exit status.
static int start_script(const CommandContext *context, const char *name) {
    const char *last = name + path_directory(str_from(name)).len;
    if (last[0] == '\0' || strcmp(last, ".fl") == 0 || strcmp(last, ".") == 0 || strcmp(last, "..") == 0) {
        message("not a script name: '%s'; try 'petri new dish'", name);
        return STATUS_USAGE;
    }
    SCOPED_TEXT path = {0};
    // Without `./`, later commands would parse a name that starts with a dash as an option.
    text_add_format(&path, "%s%s%s", name[0] == '-' ? "./" : "", name,
                    str_ends_with(str_from(name), STR(".fl")) ? "" : ".fl");
    int status = write_dish(path.bytes);
    if (status == STATUS_DONE) {
        message("created %s, a dish of drops; while 'petri view' shows it, each saved change appears at once",
                path.bytes);
        hint_pictures(context, path.bytes);
    }
    return status;
}

static int new_run(const CommandContext *context, Options *options) {
    return start_script(context, options->script);
}

const Command NEW_COMMAND = {
    .name = "new",
    .operands = "NAME",
    .summary = "create a commented example script to edit",
    .details = "Writes NAME.fl, a commented example: a dish of drops stirred by a spoon. An existing file is not\n"
               "overwritten.",
    .missing_operand = "no name given",
    .second_operand_error = "too many arguments: '%s'; petri new takes one name",
    .run = new_run,
};

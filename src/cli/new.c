// new.c: `petri new`: starts a script, with a dish to change.
#include "base/file.h"
#include "base/replace.h"
#include "base/source.h"
#include "cli/byte_buffer.h"
#include "cli/new_dish.h"
#include "cli/options.h"
#include "cli/script.h"

#include <string.h>
#include <sys/stat.h>

// Writes the dish to a file that must not exist yet.
static int write_dish(const char *path) {
    SCOPED_BYTE_BUFFER text = {0};
    for (size_t i = 0; NEW_DISH[i]; i++)
        byte_buffer_add_text(&text, NEW_DISH[i]);
    const char *problem = file_replace(path, (Str){text.data, text.length}, REPLACE_CREATE_ONLY);
    struct stat info;
    if (problem && lstat(path, &info) == 0)
        message("%s is there already, and stays as it is; choose another name", path);
    else if (problem)
        message("cannot write %s: %s", path, problem);
    return !problem ? STATUS_DONE : STATUS_FAILED;
}

// NAME is the file's name, with or without its suffix.
static int start_script(const CommandContext *context, const char *name) {
    const char *last = name + path_directory(str_from(name)).len;
    if (last[0] == '\0' || strcmp(last, ".fl") == 0 || strcmp(last, ".") == 0 || strcmp(last, "..") == 0) {
        message("'%s' is not the name of a script; try 'petri new dish'", name);
        return STATUS_USAGE;
    }
    SCOPED_BYTE_BUFFER path = {0};
    // A name that begins with a dash would be an option to the next command.
    byte_buffer_format(&path, "%s%s%s", name[0] == '-' ? "./" : "", name,
                       str_ends_with(str_from(name), STR(".fl")) ? "" : ".fl");
    int status = write_dish(path.data);
    if (status == STATUS_DONE) {
        message("%s is a dish of drops; change it, and what you save is shown at once", path.data);
        hint_pictures(context, path.data);
    }
    return status;
}

static int new_run(const CommandContext *context, Options *options) {
    return start_script(context, options->script);
}

const Command NEW_COMMAND = {
    .name = "new",
    .operands = "NAME",
    .summary = "start a script: a dish to change, with comments",
    .details =
        "Writes NAME.fl, a dish of drops that a spoon stirs, with comments that say what is what. A file that is\n"
        "there already is left alone.",
    .missing_operand = "a new script needs a name",
    .second_operand_error = "one script is started at a time; '%s' is too many",
    .run = new_run,
};

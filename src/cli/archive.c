// archive.c: see archive.h.
#include "cli/archive.h"

#include "base/source.h"
#include "cli/script.h"

#include <string.h>

// Adds a word of the command line. Absolute paths are shortened to file names, because an archive must not reveal where
// its author keeps files.
static void add_word(Text *text, const char *word) {
    const char *slash = strchr(word, '/'), *equals = strchr(word, '=');
    bool is_path = slash && (slash == word || slash == equals + (equals != NULL));
    size_t prefix = is_path ? (size_t)(slash - word) : strlen(word);
    SCOPED_TEXT whole = {0};
    text_add(&whole, (Str){word, prefix});
    if (is_path)
        text_add_c(&whole, strrchr(word, '/') + 1);
    text_add_char(text, ' ');
    shell_add_word(text, whole.bytes);
}

bool archiving_begin(Archiving *archiving, const Options *options, const char *command, PetriSession *session) {
    if (!options->archive)
        return true;
    SCOPED_TEXT words = {0};
    text_add_format(&words, "petri %s", command);
    for (int i = 0; i < options->argc; i++)
        add_word(&words, options->argv[i]);
    PetriArchiveOptions wanted = petri_archive_default_options();
    wanted.keyframe_every = options->keyframe_every;
    wanted.digest_every = options->digest_every;
    wanted.command = words.bytes;
    *archiving = (Archiving){petri_archive_create(session, options->archive, &wanted), options->archive, false};
    const char *problem = archiving->archive ? petri_archive_problem(archiving->archive) : "out of memory";
    if (!problem)
        return true;
    message("cannot write the archive '%s': %s", options->archive, problem);
    archiving_end(archiving);
    return false;
}

void archiving_check(Archiving *archiving) {
    const char *problem = petri_archive_problem(archiving->archive);
    if (!problem || archiving->failed)
        return;
    archiving->failed = true;
    message("the archive '%s' ends here: %s", archiving->name, problem);
}

bool archiving_end(Archiving *archiving) {
    if (!archiving->archive)
        return true;
    petri_archive_close(&archiving->archive);
    return !archiving->failed;
}

// unpack.c: `petri unpack`, which writes the files of an archive to a folder.
#include "archive/open.h"
#include "base/file.h"
#include "base/file_access.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Returns true for characters that could change other lines or the order of letters on a terminal.
static bool is_unsafe(int32_t c) {
    return utf8_is_control(c) || c == 0x61c || (c >= 0x200e && c <= 0x200f) || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069);
}

// Reports that a file is not written, with `?` instead of each unsafe character of its name.
static void report_skipped(const char *name) {
    SCOPED_TEXT shown = {0};
    Str all = str_from(name);
    text_add_c(&shown, "");
    for (size_t at = 0, from = 0; at < all.len; from = at) {
        bool unsafe = is_unsafe(utf8_next(all, &at));
        text_add(&shown, unsafe ? STR("?") : (Str){name + from, at - from});
    }
    message("skipped '%s': the name has control characters or a hidden part, or is not below the script's folder",
            shown.bytes);
}

// Returns true if a name has no control characters, no marks that change the direction of text, and no hidden part such
// as `.git`, and stays in the folder below which it is written.
static bool is_valid_name(const char *name) {
    if (name[0] == '/' || name[0] == '\0')
        return false;
    for (size_t at = 0, length = strlen(name); at < length;)
        if (is_unsafe(utf8_next((Str){name, length}, &at)))
            return false;
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        size_t length = strcspn(part, "/");
        if (length == 0 || part[0] == '.') // also `.` and `..`
            return false;
    }
    return true;
}

// Writes a new file. Does not replace an existing one.
static bool write_file(const char *folder, const PetriArchiveFile *file) {
    SCOPED_STRING name = memory_strdup(file->name);
    int root = file_open_at(AT_FDCWD, folder, O_RDONLY | O_DIRECTORY, 0);
    int written = root < 0 ? -1 : file_open_below(root, name, O_WRONLY | O_CREAT | O_EXCL, 0666, true);
    bool good = written >= 0 && file_write(written, file->bytes, file->length);
    int error = errno;
    if (written >= 0)
        close(written);
    if (!good)
        message("cannot write '%s' in '%s': %s", file->name, folder, strerror(error));
    return good;
}

// Returns true if a later row has another version of the file.
static bool is_replaced(PetriArchive *archive, size_t number, const char *name) {
    PetriArchiveFile later;
    while (petri_archive_file(archive, ++number, &later, sizeof later))
        if (strcmp(later.name, name) == 0)
            return true;
    return false;
}

static int unpack_files(PetriArchive *archive, const char *folder) {
    PetriArchiveFile file;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        message("cannot create '%s': %s", folder, strerror(errno));
        return STATUS_FAILED;
    }
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++) {
        bool is_folder = str_ends_with(str_from(file.name), STR("/"));
        if (is_folder || !file.bytes || is_replaced(archive, i, file.name))
            continue;
        if (!is_valid_name(file.name))
            report_skipped(file.name);
        else if (!write_file(folder, &file))
            return STATUS_FAILED;
    }
    return STATUS_DONE;
}

static int unpack_run(const CommandContext *context, Options *options) {
    (void)context;
    if (!options->second) {
        message("no folder given; usage: petri unpack RUN.petri DIR");
        return STATUS_USAGE;
    }
    PetriArchive *archive = archive_open(options, options->script);
    if (!archive)
        return STATUS_DAMAGED;
    int status = unpack_files(archive, options->second);
    if (archive_report_problem(archive, options->script))
        status = STATUS_DAMAGED;
    petri_archive_close(&archive);
    return status;
}

const Command UNPACK_COMMAND = {
    .name = "unpack",
    .operands = "RUN.petri DIR",
    .summary = "write the files of an archived run to a folder",
    .details =
        "Writes the script and all other files in an archive to the folder DIR, which is created if it does not\n"
        "exist. Writes the last version of each file. Existing files are not overwritten. Files outside the script's\n"
        "folder, hidden files and folders, such as '.git/hooks', and names with control characters are skipped.",
    .examples = "  petri unpack run.petri dish        write the files to the folder dish\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri unpack takes one archive and one folder",
    .options = FOR_INFO,
    .accepts_two = true,
    .run = unpack_run,
};

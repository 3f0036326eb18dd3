// unpack.c: `petri archive unpack`, which writes the files of an archive to a folder.
#include "archive/open.h"
#include "base/file.h"
#include "base/file_access.h"
#include "cli/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
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

// A row of the table, in the order of the names and then of the rows.
typedef struct Version {
    const char *name;
    size_t number;
} Version;

static int compare_versions(const void *a, const void *b) {
    const Version *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x->number > y->number) - (x->number < y->number);
}

static int compare_numbers(const void *a, const void *b) {
    size_t x = ((const Version *)a)->number, y = ((const Version *)b)->number;
    return (x > y) - (x < y);
}

// Lists the last version of each file, in the order of the rows. The caller frees the list.
static Version *list_last_versions(PetriArchive *archive, size_t *count) {
    Version *list = NULL;
    PetriArchiveFile file;
    size_t rows = 0, capacity = 0, last = 0;
    for (; petri_archive_file(archive, rows, &file, sizeof file); rows++) {
        if (rows == capacity) {
            capacity = 2 * capacity + 16;
            list = memory_realloc(list, capacity * sizeof *list);
        }
        list[rows] = (Version){file.name, rows};
    }
    if (rows > 0)
        qsort(list, rows, sizeof *list, compare_versions);
    for (size_t i = 0; i < rows; i++)
        if (i + 1 == rows || strcmp(list[i].name, list[i + 1].name) != 0)
            list[last++] = list[i];
    if (last > 0)
        qsort(list, last, sizeof *list, compare_numbers);
    *count = last;
    return list;
}

static bool unpack_file(const char *folder, const PetriArchiveFile *file) {
    if (str_ends_with(str_from(file->name), STR("/")) || !file->bytes)
        return true;
    if (is_valid_name(file->name))
        return write_file(folder, file);
    report_skipped(file->name);
    return true;
}

static int unpack_files(PetriArchive *archive, const char *folder) {
    PetriArchiveFile file;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        message("cannot create '%s': %s", folder, strerror(errno));
        return STATUS_FAILED;
    }
    size_t count;
    Version *list = list_last_versions(archive, &count);
    bool good = !petri_archive_problem(archive);
    for (size_t i = 0; i < count && good; i++)
        good = petri_archive_file(archive, list[i].number, &file, sizeof file) && unpack_file(folder, &file);
    free(list);
    return good ? STATUS_DONE : STATUS_FAILED;
}

static int unpack_run(const CommandContext *context, Options *options) {
    (void)context;
    if (!options->second) {
        message("no folder given; usage: petri archive unpack RUN.petri DIR");
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
    .name = "archive unpack",
    .operands = "RUN.petri DIR",
    .summary = "write the files of an archived run to a folder",
    .details =
        "Writes the script and all other files in an archive to the folder DIR, which is created if it does not\n"
        "exist. Writes the last version of each file. Existing files are not overwritten. Files outside the script's\n"
        "folder, hidden files and folders, such as '.git/hooks', and names with control characters are skipped.",
    .examples = "  petri archive unpack run.petri dish             write the files to the folder dish\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri archive unpack takes one archive and one folder",
    .options = &ARCHIVE_OPTIONS,
    .accepts_two = true,
    .run = unpack_run,
};

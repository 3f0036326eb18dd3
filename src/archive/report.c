// report.c: see report.h.
//
// Lines of a report, in this order:
//
//     petri report 1                 version of this form
//     script NAME SHA256             the script, as it was at the start,
//     file NAME SHA256               and each other file that it had read before its first frame
//     parameter NAME=VALUE
//     command TEXT                   that recorded the run
//     inputs N                       inputs and states that a host gave during the run; only the archive has them
//     spec 0.4                       version of the specification
//     petri VERSION                  the program that verified the run,
//     processor NAME                 and where
//     archive SHA256                 digest of the run (`petri archive cite`)
//     frames FIRST to LAST
//     frame N DIGEST                 each frame whose number is a multiple of 1000, and the last one
//     checksum SHA256                of all lines above
#include "archive/report.h"

#include "base/sha256.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/output.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

enum { EVERY = 1000, DIGEST_BYTES = 16 };

// Adds a line. Parts of it may come from a stranger.
static void add_line(Text *report, const char *line) {
    text_add_printable(report, str_from(line), "");
    text_add_c(report, "\n");
}

static void add_files(Text *report, PetriArchive *archive, const PetriArchiveInfo *info) {
    PetriArchiveFile file;
    for (int others = 0; others < 2; others++) {
        for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++) {
            bool is_script = strcmp(file.name, info->script) == 0;
            if (is_script == others || file.frame > info->first_frame || !file.bytes)
                continue;
            SCOPED_TEXT line = {0};
            text_add_format(&line, "%s %s %s", others ? "file" : "script", file.name, file.sha256);
            add_line(report, line.bytes);
        }
    }
}

static void add_parameters(Text *report, PetriArchive *archive) {
    const char *name, *value;
    for (size_t i = 0; petri_archive_parameter(archive, i, &name, &value); i++) {
        SCOPED_TEXT line = {0};
        text_add_format(&line, "parameter %s=%s", name, value);
        add_line(report, line.bytes);
    }
}

// Returns the number of states that a host gave after the start of the run.
static int64_t count_given(PetriArchive *archive) {
    PetriArchiveKeyframe keyframe;
    int64_t count = 0;
    for (size_t i = 1; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++)
        count += keyframe.given;
    return count;
}

// Adds the name of the processor, or of its kind.
static void add_processor(Text *report) {
    char text[200] = "";
    struct utsname names;
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(text, sizeof text, file) && strncmp(text, "model name", 10) != 0)
        text[0] = 0;
    if (file)
        fclose(file);
    text[strcspn(text, "\n")] = 0;
    const char *model = strchr(text, ':');
    SCOPED_TEXT line = {0};
    text_add_format(&line, "processor %s%s%s", uname(&names) == 0 ? names.machine : "unknown", model ? "," : "",
                    model ? model + 1 : "");
    add_line(report, line.bytes);
}

static void add_frames(Text *report, PetriArchive *archive, const PetriArchiveInfo *info) {
    uint8_t digest[DIGEST_BYTES];
    text_add_format(report, "frames %" PRId64 " to %" PRId64 "\n", info->first_frame, info->last_frame);
    int64_t frame = (info->first_frame + EVERY - 1) / EVERY * EVERY;
    for (bool last = false; !last; frame += EVERY) {
        last = frame >= info->last_frame;
        frame = last ? info->last_frame : frame;
        if (!petri_archive_digest(archive, frame, digest))
            continue;
        text_add_format(report, "frame %" PRId64 " ", frame);
        text_add_hex(report, digest, sizeof digest);
        text_add_c(report, "\n");
    }
}

bool report_write(PetriArchive *archive, const char *spec, const char *file) {
    PetriArchiveInfo info;
    SCOPED_TEXT report = {0};
    char checksum[SHA256_DIGITS];
    if (!petri_archive_info(archive, &info, sizeof info))
        return false;
    text_add_c(&report, "petri report 1\n");
    add_files(&report, archive, &info);
    add_parameters(&report, archive);
    SCOPED_TEXT command = {0};
    text_add_format(&command, "command %s", info.command);
    add_line(&report, command.bytes);
    text_add_format(&report, "inputs %" PRId64 "\nspec %s\npetri %s\n", info.inputs + count_given(archive), spec,
                    petri_version());
    add_processor(&report);
    text_add_format(&report, "archive %s\n", info.sha256);
    add_frames(&report, archive, &info);
    sha256_of(report.bytes, report.len, checksum);
    text_add_format(&report, "checksum %.*s\n", SHA256_DIGITS, checksum);
    return strcmp(file, "-") == 0 ? output_text(report.bytes, report.len, STATUS_DONE) == STATUS_DONE
                                  : output_file(file, text_str(&report));
}

// check_report.c: checks a report of `petri archive verify --report` with petri.c alone:
//
//     cc -O2 -ffp-contract=off petri.c check_report.c -o check_report -lm -lpthread
//     ./check_report report.txt dish.fl [FPS]
//
// Runs the script with the parameters and by the version of the specification in the report, and compares the digests.
// Exits with 0 if all are equal. FPS is needed if the run had --fps. `sha256sum` checks the sums of script and report.
#include "petri-inspect.h"
#include "petri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    (void)user_data;
    fputs(diagnostic->rendered, stderr);
}

static int fail(const char *message, const char *detail) {
    fprintf(stderr, "check_report: %s%s\n", message, detail);
    return 2;
}

// Steps to a frame and compares its digest. Returns 0 if it is equal, 1 if it differs, and 2 if it cannot be computed.
static int check_frame(PetriSession *session, int64_t frame, const char *digest) {
    unsigned char bytes[16];
    char digits[33];
    while (petri_frame_number(session) < frame)
        if (petri_step(session) != PETRI_OK)
            return fail("cannot compute a frame", "");
    if (petri_digest(session, bytes) != PETRI_OK)
        return fail("out of memory", "");
    for (int i = 0; i < 16; i++)
        snprintf(digits + 2 * (size_t)i, 3, "%02x", bytes[i]);
    bool same = strcmp(digits, digest) == 0;
    printf("frame %lld: %s\n", (long long)frame, same ? "equal" : "differs");
    return !same;
}

// Reads the next line, of any length. Returns false at the end.
static bool read_line(FILE *report, char **line, size_t *capacity) {
    bool found = getline(line, capacity, report) >= 0;
    if (found)
        (*line)[strcspn(*line, "\n")] = 0;
    return found;
}

// Opens a session for the version of the specification in a report, which must end with its checksum.
static PetriSession *open_session(FILE *report, const char *fps, char **line, size_t *capacity) {
    char spec[32] = "";
    PetriOptions options = petri_default_options();
    options.fps = fps ? atof(fps) : options.fps;
    options.on_diagnostic = on_diagnostic;
    options.spec = spec;
    bool complete = false;
    while (read_line(report, line, capacity)) {
        sscanf(*line, "spec %31[^\n]", spec);
        complete = strncmp(*line, "checksum ", 9) == 0;
    }
    rewind(report);
    PetriSession *session = complete ? petri_open(&options) : NULL;
    if (!session)
        fail(complete ? petri_options_problem(&options) : "not a whole report: it does not end with its checksum", "");
    return session;
}

// Executes a line of the report. Returns 0, 1 if a frame differs, and 2 if the report cannot be checked.
static int check_line(PetriSession *session, const char *script, const char *line, int *checked) {
    char digest[64];
    long long frame;
    if (strncmp(line, "parameter ", 10) == 0 && petri_define(session, line + 10) != PETRI_OK)
        return fail("cannot set a parameter: ", line + 10);
    if (strncmp(line, "inputs ", 7) == 0 && strcmp(line, "inputs 0") != 0)
        return fail("the run had inputs, which only its archive has", "");
    if (sscanf(line, "frames %lld", &frame) == 1) {
        if (frame != 0)
            return fail("the run does not begin with frame 0", "");
        return petri_load(session, script) == PETRI_OK ? 0 : fail("cannot load the script", "");
    }
    if (sscanf(line, "frame %lld %63s", &frame, digest) != 2)
        return 0;
    (*checked)++;
    return check_frame(session, frame, digest);
}

int main(int argc, char **argv) {
    char *line = NULL;
    size_t capacity = 0;
    int result = 0, checked = 0;
    FILE *report = argc >= 3 ? fopen(argv[1], "r") : NULL;
    if (!report)
        return fail("usage: check_report REPORT SCRIPT [FPS]", "");
    PetriSession *session = open_session(report, argv[3], &line, &capacity);
    while (session && result < 2 && read_line(report, &line, &capacity)) {
        int found = check_line(session, argv[2], line, &checked);
        result = found > result ? found : result;
    }
    free(line);
    fclose(report);
    result = session ? result : 2;
    petri_close(&session);
    return result == 0 && checked == 0 ? fail("the report has no frames: ", argv[1]) : result;
}

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

// Reads the lines of a report, and checks each frame. The session is opened at the line `spec`, after which no
// parameters follow.
int main(int argc, char **argv) {
    char line[1024], spec[32] = "", digest[64], definitions[64][1024];
    long long frame;
    int defined = 0, result = 0, checked = 0;
    PetriSession *session = NULL;
    FILE *report = argc >= 3 ? fopen(argv[1], "r") : NULL;
    if (!report)
        return fail("usage: check_report REPORT SCRIPT [FPS]", "");
    while (result < 2 && fgets(line, sizeof line, report)) {
        line[strcspn(line, "\n")] = 0;
        if (strncmp(line, "parameter ", 10) == 0 && defined < 64)
            snprintf(definitions[defined++], sizeof definitions[0], "%s", line + 10);
        else if (strncmp(line, "inputs ", 7) == 0 && strcmp(line, "inputs 0") != 0)
            result = fail("the run had inputs, which only its archive has", "");
        else if (sscanf(line, "frames %lld", &frame) == 1 && frame != 0)
            result = fail("the run does not begin with frame 0", "");
        else if (sscanf(line, "spec %31s", spec) == 1) {
            PetriOptions options = petri_default_options();
            options.fps = argc > 3 ? atof(argv[3]) : options.fps;
            options.on_diagnostic = on_diagnostic;
            options.spec = spec;
            session = petri_open(&options);
            for (int i = 0; session && i < defined; i++)
                petri_define(session, definitions[i]);
            if (!session || petri_load(session, argv[2]) != PETRI_OK)
                result = fail(session ? "cannot load the script" : petri_options_problem(&options), "");
        } else if (session && sscanf(line, "frame %lld %63s", &frame, digest) == 2) {
            int found = check_frame(session, frame, digest);
            result = found > result ? found : result;
            checked++;
        }
    }
    fclose(report);
    petri_close(&session);
    return result == 0 && checked == 0 ? fail("not a report: ", argv[1]) : result;
}

// suite.h: tests of scripts. A test is a file NAME.SUFFIX beside NAME.fl that records what the script does.
//
// Each suffix is a kind of test (kinds.c). To add a kind, write its functions in a separate file and add a row there.
#pragma once

#include "cli/output.h"
#include "cli/subprocess.h"
#include "golden/golden.h"
#include "golden/options.h"

#include <sys/stat.h>

typedef struct TestKind TestKind;

typedef struct TestCase {
    const CommandContext *host;
    Result result;
    const TestKind *kind;
    char *script;   // path of the script
    char *name;     // file name of the script, without folders; part of `script`
    char *recorded; // path of the file that records what the script does
    char *drawn;    // folder that the run draws into; NULL: none
    Golden golden;  // of kinds that begin with a line of options; valid while the script runs
    Subprocess child;
    bool done;
} TestCase;

// What a child process has left.
typedef struct RunOutput {
    int status; // as from waitpid
    Text output;
    Text errors;
} RunOutput;

struct TestKind {
    const char *suffix; // of the file, such as ".golden"
    bool follows_runs;  // true if a difference can be followed with `petri diff`
    bool names_script;  // true if the file names its script itself, which need not be NAME.fl
    bool own_name;      // true if results have the name of the file, false if they have that of the script
    // Reads the file and adds the words of the command to execute in the script's folder, after the program. On failure
    // returns false and adds the reason to result.error_text.
    bool (*begin)(const Options *options, TestCase *test, TextList *words);
    // Compares what the command printed with the file or, with --update, records it. Sets the result.
    void (*end)(const Options *options, TestCase *test, const RunOutput *run);
    // Shows what was recorded and what there is now, as pictures. Returns false if there are none. NULL: never
    // possible.
    bool (*show)(Output *output, TestCase *test);
    void (*discard)(TestCase *test); // deletes files that a failure has left; NULL: there are none
};

// kinds.c: all kinds, then one without a suffix; and their suffixes, then NULL.
extern const TestKind TEST_KINDS[];
extern const char *const TEST_SUFFIXES[];
// Returns the kind of a test file, or NULL.
const TestKind *kind_of_file(const char *path);
// Returns the path NAME.SUFFIX for a file NAME.fl, or for a test file of this kind. The caller frees it.
char *kind_path(const char *path, const char *suffix);

// run_kind.c: goldens of `petri run`.
bool run_kind_begin(const Options *options, TestCase *test, TextList *words);
void run_kind_end(const Options *options, TestCase *test, const RunOutput *run);

// pictures.c: goldens of `petri render`.
bool pictures_begin(const Options *options, TestCase *test, TextList *words);
void pictures_end(const Options *options, TestCase *test, const RunOutput *run);
bool pictures_show(Output *output, TestCase *test);
void pictures_discard(TestCase *test);

// properties.c: NAME.properties.
bool properties_begin(const Options *options, TestCase *test, TextList *words);
void properties_end(const Options *options, TestCase *test, const RunOutput *run);

// run_output.c: the output of a run.

// Adds the words that all runs have: overrides of options, and the script after `--`.
void run_add_common(const Options *options, const TestCase *test, TextList *words);
// Returns the first line of the script `name` in the messages of a run, or `wanted` if they name that line too; 0: they
// name none.
long run_message_line(const char *name, const Text *errors, long wanted);
// Puts the reason why a run failed, and the line of its error, into the result.
void run_describe(TestCase *test, const RunOutput *run);
// Returns true if a run computed all frames.
bool run_is_complete(int status, const Text *errors);
// Returns true if a run reported that its motion became meaningless, and adds this warning to error_text.
bool run_has_diverged(const Text *errors, Text *error_text);

// rejection.c: NAME.err, for scripts that must be rejected.
bool rejection_begin(const Options *options, TestCase *test, TextList *words);
void rejection_end(const Options *options, TestCase *test, const RunOutput *run);
// Returns the contents of an .err file for the errors of a run of the script `name`: `line N` and the messages. Empty
// if no error has a line.
Text rejection_text(const char *name, const Text *errors);

// session.c: NAME.session, transcripts of `petri repl`.
bool session_begin(const Options *options, TestCase *test, TextList *words);
void session_end(const Options *options, TestCase *test, const RunOutput *run);

// execute.c: execution of one test.

// Starts the command of the test, or sets `done` if that is not possible.
void execute_start(const CommandContext *host, const Options *options, TestCase *test);
// Sets the result of a test whose process has ended with this status.
void execute_end(const Options *options, TestCase *test, int status);
// Frees what a test owns.
void test_free(TestCase *test);
// Executes a test whose process has ended once more, from start to end.
void execute_again(const CommandContext *host, const Options *options, TestCase *test);

// cause.c: why a run differs, from `petri diff` of the script as it was when the output was recorded, and now.

// Adds the cause to the details of a test whose output differs, if it can be found within `seconds` and git has the old
// script. If there is not enough time, adds the command that finds it. Returns false if nothing is added.
bool cause_add(const CommandContext *host, TestCase *test, unsigned seconds);
// Adds the command that accepts the new output.
void hint_add(const CommandContext *host, TestCase *test);

// find.c: the tests in the operands.
typedef struct TestList {
    TestCase *items; // sorted by name
    size_t count;
    size_t untested; // number of scripts without a test
} TestList;

// The caller frees the list with tests_free.
TestList tests_find(const Options *options);
void tests_free(TestList *list);

// review.c: decisions about differences, which the user types.
typedef struct Review {
    const CommandContext *host;
    const Options *options;
    size_t asked;
    size_t accepted;
    size_t rejected;
    bool ended; // true: ask no more
} Review;

// Asks what to do with a test whose output differs and has been shown.
void review_ask(Review *review, Output *output, TestCase *test);
void review_report(const Review *review, Output *output);

// watch.c: the files on which tests depend.
typedef struct WatchedFile {
    char *path;
    struct stat version;
    bool changed; // before the end of the last watch_wait
} WatchedFile;

typedef struct Watch {
    struct FileWatch *watch;
    WatchedFile *files;
    size_t count;
} Watch;

// The caller frees the watch with watch_free.
Watch *watch_new(const TestList *tests);
void watch_free(Watch *watch);
// Waits until a file has changed.
void watch_wait(Watch *watch);
// Removes the tests that no changed file affects. Watches the files of the others, which may depend on more files now.
void watch_select(Watch *watch, TestList *tests);

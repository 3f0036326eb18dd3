// cause.c: why a run differs; see suite.h.
#include "base/source.h"
#include "cli/script.h"
#include "golden/suite.h"

#include <string.h>
#include <sys/wait.h>

typedef struct Search {
    const CommandContext *host;
    const Golden *golden;
    TestCase *test;
    unsigned seconds; // that git and `petri diff` may take
} Search;

// Runs petri in the folder of the script. Returns its exit status, or -1.
static int run_there(const Search *search, const TextList *words, Text *output) {
    SCOPED_STRING folder = memory_folder(search->test->script);
    SCOPED_TEXT errors = {0};
    int status = subprocess_run(search->host->program, folder, words->items, search->seconds, output, &errors);
    return status >= 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Adds the options of the golden that matter to `petri diff`.
static void add_options(const Golden *golden, TextList *words) {
    static const char kept[] = "frames fps define allow-read no-files memory work";
    for (size_t i = 0; i < golden->options.count; i++) {
        const char *word = golden->options.items[i];
        const OptionSpec *spec = golden_option(golden_rows(golden), word);
        bool used = spec && str_word_number(str_from(spec->name), kept) >= 0;
        bool more = spec && spec->value && golden_option_is_alone(word);
        if (used)
            texts_add(words, word);
        if (used && more && i + 1 < golden->options.count)
            texts_add(words, golden->options.items[i + 1]);
        i += more ? 1 : 0;
    }
}

// Adds the words of `petri diff REVISION:NAME NAME`. `folder` is put before the names.
static void add_diff(const Search *search, const char *revision, const char *folder, TextList *words) {
    texts_add(words, "diff");
    texts_add_format(words, "%s:%s%s", revision, folder, search->test->name);
    texts_add_format(words, "%s%s", folder, search->test->name);
    add_options(search->golden, words);
}

// Finds the cause of the difference between the script of a revision and now. Returns the exit status of `petri diff`.
static int try_revision(const Search *search, const char *revision, Text *output) {
    TextList words = {0};
    texts_add(&words, "petri");
    add_diff(search, revision, search->test->name[0] == '-' ? "./" : "", &words);
    int status = run_there(search, &words, output);
    texts_free(&words);
    return status;
}

// Returns the commit that last changed the golden, or an empty text if git does not know any.
static Text recording_commit(const Search *search) {
    static const char *const parts[] = {"rev-list", "-1", "--abbrev-commit", "HEAD", "--"};
    const char *golden = search->test->recorded;
    SCOPED_STRING folder = memory_folder(search->test->script);
    SCOPED_TEXT errors = {0};
    TextList words = {0};
    Text commit = {0};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        texts_add(&words, parts[i]);
    texts_add(&words, golden + path_directory(str_from(golden)).len);
    int status = subprocess_git(folder, &words, search->seconds, &commit, &errors);
    if (status < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        commit.len = 0;
    while (commit.len > 0 && commit.bytes[commit.len - 1] == '\n')
        commit.bytes[--commit.len] = '\0';
    texts_free(&words);
    return commit;
}

static void add_command(const CommandContext *host, const TextList *words, Text *details) {
    shell_add_program(details, host->invoked_as);
    for (size_t i = 0; i < words->count; i++) {
        text_add_c(details, " ");
        shell_add_word(details, words->items[i]);
    }
    text_add_c(details, "\n");
}

// Adds the command that finds the cause if there is more time.
static void add_diff_command(const Search *search, const char *revision) {
    TestCase *test = search->test;
    SCOPED_STRING folder = memory_strndup(test->script, (size_t)(test->name - test->script));
    TextList words = {0};
    add_diff(search, revision, folder, &words);
    text_add_c(&test->result.details, "to find the cause: ");
    add_command(search->host, &words, &test->result.details);
    texts_free(&words);
}

static bool find_cause(const Search *search) {
    enum { SAME = 0, DIFFERS = 1, TROUBLE = 2 };
    SCOPED_TEXT output = {0}, commit = {0};
    const char *revision = "HEAD";
    int status = try_revision(search, revision, &output);
    if (status == SAME) { // the script was committed, but perhaps not recorded again
        commit = recording_commit(search);
        output.len = 0;
        revision = commit.bytes;
        status = commit.len == 0 ? TROUBLE : try_revision(search, revision, &output);
    }
    if (status == DIFFERS)
        text_add_format(&search->test->result.details, "cause, from the script as git has it:\n%s", output.bytes);
    else if (status != TROUBLE && status != SAME)
        add_diff_command(search, revision);
    return status != TROUBLE && status != SAME;
}

bool cause_add(const CommandContext *host, TestCase *test, unsigned seconds) {
    Golden golden;
    SCOPED_TEXT problem = {0};
    if (!test->kind->follows_runs || !golden_read(&golden, test->recorded, &problem))
        return false;
    const Search search = {host, &golden, test, seconds};
    bool found = find_cause(&search);
    golden_free(&golden);
    return found;
}

void hint_add(const CommandContext *host, TestCase *test) {
    TextList words = {0};
    texts_add(&words, "test");
    texts_add(&words, "--update");
    texts_add(&words, test->recorded);
    text_add_c(&test->result.details, "to accept: ");
    add_command(host, &words, &test->result.details);
    texts_free(&words);
}

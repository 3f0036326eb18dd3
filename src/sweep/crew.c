// crew.c: see crew.h. Each hand is a process that was forked before it had a session; it reads the numbers of runs from
// a pipe and writes what came of them to another. It has its next run when it ends one, so that it never waits.
//
// Under mpirun each process has a crew. That of rank 0 deals runs to the others, too: each of them sends a letter for
// each run that it wishes for, and then one for each that it has made, which stands for the next wish.
#include "sweep/crew.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "base/file.h"
#include "cli/mail.h"
#include "sweep/measure.h"

enum { AHEAD = 2, REDRAW = 200, LETTERS = 2 }; // runs that a hand has; milliseconds, of the last two

typedef struct Hand {
    pid_t pid;
    int orders;          // numbers of runs go here
    int news;            // News comes from here
    int64_t held[AHEAD]; // runs that it has, the one that it makes first
    int count;
} Hand;

// What comes before the rows and the diagnostics of a run.
typedef struct News {
    int64_t run;
    int64_t frames;
    uint64_t rows; // bytes
    uint64_t told;
} News;

typedef struct Crew {
    Sweep *sweep;
    Journal *journal;
    Hand *hands;
    int64_t jobs;
    size_t next;   // no run before it is to be dealt out, but for these
    int64_t *back; // runs to be dealt out first: of hands that are gone, or from rank 0
    size_t backs;
    const Mail *mail; // NULL: there are no other processes
    bool ended;       // rank 0 has said so
    int64_t wanted;   // runs to be made, and how many are
    int64_t done;
    Progress progress;
} Crew;

static const int64_t NO_MORE = -1; // in place of a run

static volatile sig_atomic_t stopped; // a signal handler can reach nothing else

static void on_signal(int number) {
    stopped = number;
}

// False at the end, or if the other side is gone.
static bool read_all(int fd, void *data, size_t length) {
    for (char *at = data; length > 0;) {
        ssize_t count = read(fd, at, length);
        if (count == 0 || (count < 0 && errno != EINTR)) {
            return false;
        }
        at += count < 0 ? 0 : count;
        length -= count < 0 ? 0 : (size_t)count;
    }
    return true;
}

// --- in a process of the crew

// Diagnostics go to the parent as they are, a byte for the level before each and NUL behind.
static void collect(void *context, PetriLevel level, const char *rendered) {
    enum { MOST = 1 << 16 };
    Bytes *told = context;
    if (told->length < MOST) {
        bytes_format(told, "%c", 'a' + (int)level);
        bytes_add(told, rendered, strlen(rendered) + 1);
    }
}

static int obey(const Sweep *sweep, int orders, int news) {
    Measure measure;
    Bytes told = {0};
    if (!measure_open(&measure, sweep, collect, &told)) {
        return STATUS_FAILED;
    }
    int64_t run = 0;
    while (read_all(orders, &run, sizeof run)) {
        told.length = 0;
        measure_run(&measure, (size_t)run);
        News head = {run, measure.frames, measure.rows.length, told.length};
        if (!file_write(news, (const char *)&head, sizeof head) ||
            !file_write(news, measure.rows.data, measure.rows.length) || !file_write(news, told.data, told.length)) {
            break;
        }
    }
    measure_close(&measure);
    bytes_free(&told);
    return STATUS_DONE;
}

// Ctrl-C is sent to all processes of a terminal: it is for the parent, with which this one ends.
static void become_hand(const Crew *crew, int orders, int news, pid_t parent) {
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++) {
        signal(ignored[i], SIG_IGN);
    }
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    for (int64_t i = 0; i < crew->jobs; i++) { // else those do not see the parent's end
        if (crew->hands[i].pid > 0) {
            close(crew->hands[i].orders);
            close(crew->hands[i].news);
        }
    }
    _exit(getppid() != parent ? STATUS_FAILED : obey(crew->sweep, orders, news));
}

// --- in the parent

static bool start_hand(Crew *crew, Hand *hand) {
    int orders[2] = {-1, -1}, news[2] = {-1, -1};
    pid_t parent = getpid();
    hand->pid = pipe(orders) == 0 && pipe(news) == 0 ? fork() : -1;
    if (hand->pid == 0) {
        hand->pid = -1;
        close(orders[1]);
        close(news[0]);
        become_hand(crew, orders[0], news[1], parent);
    }
    int error = errno;
    close(orders[0]);
    close(news[1]);
    hand->orders = orders[1];
    hand->news = news[0];
    hand->count = 0;
    if (hand->pid < 0) {
        close(orders[1]);
        close(news[0]);
        message("cannot start a process: %s", strerror(error));
    }
    return hand->pid > 0;
}

static bool is_far(const Crew *crew) {
    return crew->mail != NULL && crew->mail->rank > 0;
}

// The next run to be made, or -1.
static int64_t next_run(Crew *crew) {
    if (crew->backs > 0) {
        return crew->back[--crew->backs];
    }
    for (; !is_far(crew) && crew->next < crew->sweep->design.run_count; crew->next++) {
        if (sweep_is_ours(crew->sweep, crew->next) && crew->sweep->results[crew->next].rows == NULL) {
            return (int64_t)crew->next++;
        }
    }
    return -1;
}

// The hands take turns, so that none has two runs while another has none. One that is gone is noticed later.
static void deal(Crew *crew) {
    for (int most = 1; most <= AHEAD; most++) {
        for (int64_t i = 0; i < crew->jobs; i++) {
            Hand *hand = &crew->hands[i];
            int64_t run = hand->count < most && hand->pid > 0 ? next_run(crew) : -1;
            if (run >= 0) {
                hand->held[hand->count++] = run;
                if (!file_write(hand->orders, (const char *)&run, sizeof run)) {
                    kill(hand->pid, SIGKILL); // it would wait for ever for orders, and this process for it
                }
            }
        }
    }
}

// What has come of a run: the rows, then what was told.
static bool keep(Crew *crew, const News *head, const char *bytes) {
    size_t length = (size_t)(head->rows + head->told), run = (size_t)head->run;
    crew->done++;
    if (is_far(crew)) {
        SCOPED_BYTES letter = {0};
        bytes_add(&letter, (const char *)head, sizeof *head);
        bytes_add(&letter, bytes, length);
        crew->mail->send(0, letter.data, letter.length);
        return true;
    }
    progress_erase(&crew->progress);
    for (const char *told = bytes + head->rows; told < bytes + length; told += strlen(told) + 1) {
        sweep_tell(crew->sweep, (PetriLevel)(told[0] - 'a'), told + 1);
    }
    sweep_keep(crew->sweep, run, head->frames, bytes, (size_t)head->rows);
    return journal_add(crew->journal, run, &crew->sweep->results[run]);
}

static bool take_news(Crew *crew, Hand *hand, bool *gone) {
    News head;
    *gone = !read_all(hand->news, &head, sizeof head);
    if (*gone) {
        return true;
    }
    size_t length = (size_t)(head.rows + head.told);
    SCOPED_TEXT bytes = memory_zeroed(length + 1);
    *gone = !read_all(hand->news, bytes, length);
    if (*gone) {
        return true;
    }
    memmove(hand->held, hand->held + 1, sizeof hand->held - sizeof hand->held[0]);
    hand->count--;
    return keep(crew, &head, bytes);
}

// Rank 0 takes wishes and what was made, the others runs.
static bool take_mail(Crew *crew) {
    SCOPED_BYTES letter = {0};
    bool good = true;
    for (int from = 0; good && crew->mail != NULL && crew->mail->take(&from, &letter); letter.length = 0) {
        if (is_far(crew)) {
            int64_t run;
            memcpy(&run, letter.data, sizeof run);
            crew->ended = crew->ended || run == NO_MORE;
            crew->back[crew->backs] = run;
            crew->backs += run != NO_MORE;
            continue;
        }
        News head = {.run = NO_MORE};
        memcpy(&head, letter.data, letter.length < sizeof head ? letter.length : sizeof head);
        good = letter.length < sizeof head || keep(crew, &head, letter.data + sizeof head);
        int64_t run = next_run(crew);
        if (run >= 0) {
            crew->mail->send(from, &run, sizeof run);
        }
    }
    return good;
}

// What ended the process is the row of the run that it made. Only SIGKILL comes from outside, such as a machine that is
// short of memory: then the run has a second chance.
static bool bury(Crew *crew, Hand *hand) {
    int status = 0;
    while (waitpid(hand->pid, &status, 0) < 0 && errno == EINTR) {
    }
    close(hand->orders);
    close(hand->news);
    hand->pid = -1;
    for (int i = hand->count - 1; i > 0; i--) {
        crew->back[crew->backs++] = hand->held[i];
    }
    Result *result = hand->count > 0 ? &crew->sweep->results[hand->held[0]] : NULL;
    if (result != NULL && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL && !result->killed) {
        result->killed = true;
        crew->back[crew->backs++] = hand->held[0];
        return true;
    }
    SCOPED_BYTES row = {0};
    bytes_format(&row, "0");
    for (size_t i = 0; i <= crew->sweep->metric_count; i++) {
        bytes_format(&row, "\t");
    }
    if (WIFSIGNALED(status)) {
        bytes_format(&row, "crashed: signal %d (%s)\n", WTERMSIG(status), strsignal(WTERMSIG(status)));
    } else {
        bytes_format(&row, "the process ended with status %d\n", WEXITSTATUS(status));
    }
    return result == NULL || keep(crew, &(News){hand->held[0], 0, row.length, 0}, row.data);
}

// Takes what the hands have to tell, or waits for it. False if there is no going on.
static bool follow(Crew *crew) {
    struct pollfd *waits = memory_zeroed((size_t)crew->jobs * sizeof *waits);
    bool good = true;
    for (int64_t i = 0; i < crew->jobs; i++) {
        waits[i] = (struct pollfd){.fd = crew->hands[i].pid > 0 ? crew->hands[i].news : -1, .events = POLLIN};
    }
    int patience = crew->mail != NULL ? LETTERS : crew->progress.enabled ? REDRAW : -1;
    int ready = poll(waits, (nfds_t)crew->jobs, patience);
    for (int64_t i = 0; good && ready > 0 && i < crew->jobs; i++) {
        bool gone = false;
        if (waits[i].revents != 0) {
            good = take_news(crew, &crew->hands[i], &gone);
        }
        if (good && gone) {
            good = bury(crew, &crew->hands[i]) && start_hand(crew, &crew->hands[i]);
        }
    }
    free(waits);
    return good && take_mail(crew);
}

// The first letters, and the last.
static void wish(const Crew *crew) {
    for (int64_t i = 0; is_far(crew) && i < crew->jobs * AHEAD; i++) {
        crew->mail->send(0, "", 1);
    }
}

static void say_end(const Crew *crew) {
    for (int rank = 1; crew->mail != NULL && crew->mail->rank == 0 && rank < crew->mail->count; rank++) {
        crew->mail->send(rank, &NO_MORE, sizeof NO_MORE);
    }
}

static int64_t count_wanted(const Sweep *sweep) {
    int64_t count = 0;
    for (size_t run = 0; run < sweep->design.run_count; run++) {
        count += sweep_is_ours(sweep, run) && sweep->results[run].rows == NULL;
    }
    return count;
}

static void catch_signals(void) {
    stopped = 0;
    signal_catch(SIGINT, on_signal, 0);
    signal_catch(SIGTERM, on_signal, 0);
    signal_catch(SIGHUP, on_signal, 0);
}

static void dismiss(Crew *crew) {
    for (int64_t i = 0; i < crew->jobs; i++) {
        Hand *hand = &crew->hands[i];
        if (hand->pid > 0) {
            close(hand->orders);
            kill(hand->pid, SIGKILL);
            waitpid(hand->pid, NULL, 0);
            close(hand->news);
        }
    }
}

static bool has_work(const Crew *crew) {
    return is_far(crew) ? !crew->ended : crew->done < crew->wanted;
}

int crew_work(Sweep *sweep, Journal *journal, int64_t jobs) {
    Crew crew = {.sweep = sweep, .journal = journal, .wanted = count_wanted(sweep), .mail = sweep->host->mail};
    crew.jobs = jobs < crew.wanted || is_far(&crew) ? jobs : crew.wanted;
    crew.hands = memory_zeroed((size_t)crew.jobs * sizeof *crew.hands);
    crew.back = memory_zeroed((size_t)crew.jobs * (2 * AHEAD + 1) * sizeof *crew.back);
    catch_signals();
    bool good = true;
    for (int64_t i = 0; good && i < crew.jobs; i++) {
        good = start_hand(&crew, &crew.hands[i]);
    }
    progress_start(&crew.progress, sweep->options->verbosity > LOG_QUIET && progress_possible(), crew.wanted);
    crew.progress.things = "runs";
    wish(&crew);
    while (good && has_work(&crew) && !stopped) {
        deal(&crew);
        good = follow(&crew);
        progress_update(&crew.progress, crew.done);
    }
    bool done = !has_work(&crew);
    if (good && done) {
        say_end(&crew);
    }
    progress_erase(&crew.progress);
    dismiss(&crew);
    free(crew.hands);
    free(crew.back);
    return !good ? STATUS_FAILED : done ? STATUS_DONE : STATUS_SIGNAL + (int)stopped;
}

// progress.c: see progress.h.
#include "cli/progress.h"

#include "base/clock.h"
#include "base/os.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BAR_WIDTH = 30, DEFAULT_COLUMNS = 80, MAX_SECONDS = 999 * 60 };

static const double REDRAW_SECONDS = 0.1;

bool progress_possible(void) {
    const char *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && (!terminal || strcmp(terminal, "dumb") != 0);
}

void progress_start(Progress *progress, bool enabled, int64_t total) {
    *progress =
        (Progress){.enabled = enabled && total > 0, .total = total, .things = "frames", .start = clock_seconds()};
}

void terminal_extent(int fd, int *columns, int *rows) {
    OsTerminalSize size;
    if (os_terminal_size(fd, &size) && size.columns > 0 && size.rows > 0) {
        *columns = size.columns;
        *rows = size.rows;
    }
}

static void draw_line(const Progress *progress, int64_t done, double elapsed) {
    double rate = elapsed > 0 ? (double)done / elapsed : 0;
    double left = rate > 0 ? (double)(progress->total - done) / rate : 0;
    long long seconds = left < MAX_SECONDS ? (long long)left : MAX_SECONDS;
    char numbers[128];
    int length = snprintf(numbers, sizeof numbers, "%lld/%lld %s", (long long)done, (long long)progress->total,
                          progress->things);
    if (done > 0) {
        length += snprintf(numbers + length, sizeof numbers - (size_t)length, ", %.1f %s/s, %lld:%02lld left", rate,
                           progress->things, seconds / 60, seconds % 60);
    }
    char bar[BAR_WIDTH + 4] = "";
    int columns = DEFAULT_COLUMNS, rows = 0;
    terminal_extent(STDERR_FILENO, &columns, &rows);
    // A wrapped line cannot be erased, so the bar is left out if it does not fit.
    if (length + BAR_WIDTH + 3 < columns) {
        int filled = (int)((double)done / (double)progress->total * BAR_WIDTH);
        bar[0] = '[';
        memset(bar + 1, '#', (size_t)filled);
        memset(bar + 1 + filled, '.', (size_t)(BAR_WIDTH - filled));
        memcpy(bar + 1 + BAR_WIDTH, "] ", 3);
    }
    fprintf(stderr, "\r\033[K%s%.*s", bar, columns > 1 ? columns - 1 : 1, numbers);
    fflush(stderr);
}

void progress_update(Progress *progress, int64_t done) {
    if (!progress->enabled)
        return;
    double now = clock_seconds();
    if (progress->last != 0 && now - progress->last < REDRAW_SECONDS)
        return;
    progress->last = now;
    progress->drawn = true;
    draw_line(progress, done < progress->total ? done : progress->total, now - progress->start);
}

void progress_erase(Progress *progress) {
    if (progress->drawn) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
        progress->drawn = false;
    }
}

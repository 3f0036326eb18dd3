// test_fences.c: checks that Mesa's llvmpipe does not free a fence while one of its threads
// signals it (lib/gl/context.c explains the problem). To provoke the problem, the test slows Mesa's threads down while
// they signal, and slightly slows down the drawing thread. Mesa calls the functions that are defined here instead of
// those of the C library.
#define _GNU_SOURCE // for dlvsym and gettid
#include "drawn.h"

#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <stdatomic.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <unistd.h>

#define SEEN __attribute__((visibility("default"))) // exported, so that libraries call it

enum { THREADS = 64, ONE_IN = 3, SLOW_US = 3000, DRAWING_US = 1500 };

static _Atomic(uintptr_t) signalled[THREADS]; // condition variables that are being signalled, by thread; 0: none
static atomic_int slowed;

extern void __libc_free(void *memory);

static void stop(void) {
    static const char text[] = "a fence is freed while it is signalled\n";
    ssize_t written = write(STDERR_FILENO, text, strlen(text));
    _exit(written > 0 ? 1 : 2);
}

SEEN void free(void *memory) {
    uintptr_t at = (uintptr_t)memory;
    for (int i = 0; at && i < THREADS; i++) {
        uintptr_t condition = atomic_load(&signalled[i]);
        if (at <= condition && condition < at + malloc_usable_size(memory))
            stop(); // exits now, because the signalling thread would hang later
    }
    __libc_free(memory);
}

// The C library also has an older version for old programs, so this code looks up the newest one.
static int real(const char *name, pthread_cond_t *condition) {
    void *found = dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2");
    int (*function)(pthread_cond_t *) = NULL;
    found = found ? found : dlsym(RTLD_NEXT, name);
    memcpy(&function, &found, sizeof function);
    return function(condition);
}

SEEN int pthread_cond_broadcast(pthread_cond_t *condition) {
    static _Thread_local unsigned count;
    static const char rasterizer[] = "llvmpipe-";
    char name[16] = "";
    prctl(PR_GET_NAME, name);
    if (strncmp(name, rasterizer, strlen(rasterizer)) == 0 && ++count % ONE_IN == 0) {
        _Atomic(uintptr_t) *own = &signalled[atoi(name + strlen(rasterizer)) % THREADS];
        atomic_store(own, (uintptr_t)condition);
        usleep(SLOW_US);
        atomic_store(own, 0);
        atomic_fetch_add(&slowed, 1);
    }
    return real("pthread_cond_broadcast", condition);
}

SEEN int pthread_cond_signal(pthread_cond_t *condition) {
    static unsigned count;
    int result = real("pthread_cond_signal", condition);
    if (gettid() == getpid() && ++count % 2 == 0)
        usleep(DRAWING_US);
    return result;
}

static void test_fence_is_not_freed_while_signalled(void **state) {
    (void)state;
    enum { TIMES = 12, FRAMES = 3 };
#define PROGRAM(size, text)                                                                                            \
    "    !shader size=" size " fragment=\"\"\"${HEADER}\nin vec2 coord;\nout vec4 color;\n"                            \
    "void main() { color = vec4(" text ", 1.0); }\n\"\"\"\n"
    static const char *const scripts[] = {
        "!window size=30;20 colorbits=32 composite=:add\n" PROGRAM("30;20", "coord, 0.2")
            PROGRAM("30;20", "coord.y, 0.7, coord.x * coord.y") PROGRAM("11;7", "0.1, coord"),
        "!window size=30;20 colorbits=32 repeat=true\n" PROGRAM("30;20", "coord, 0.3")
            PROGRAM("30;20", "coord.x, 0.5, coord.x * coord.y") PROGRAM("11;7", "0.2, coord"),
    };
#undef PROGRAM
    for (int i = 0; i < TIMES * (int)COUNT_OF(scripts); i++) {
        Drawn drawn;
        drawn_open(&drawn, scripts[i % (int)COUNT_OF(scripts)], FRAMES);
        assert_string_equal(drawn.reported, "");
        drawn_close(&drawn);
    }
    if (atomic_load(&slowed) == 0)
        skip(); // skipped with another driver
}

int main(void) {
    static const struct CMUnitTest tests[] = {cmocka_unit_test(test_fence_is_not_freed_while_signalled)};
    enum { SKIP = 77 };
    return drawn_can_run() ? cmocka_run_group_tests(tests, NULL, NULL) : SKIP;
}

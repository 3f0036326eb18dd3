// fail_nth.c: preloaded library that lets allocations of the program fail: the N-th one (FAIL_AT=N), or all from the
// N-th on (FAIL_FROM=N). At exit, the number of the program's allocations is written to COUNT_FILE. With FAIL_TELL, the
// return address of each failed allocation is printed to stderr, for addr2line.
//
// Allocations by other libraries never fail, because some libraries (such as GLib, which Pango uses) then abort the
// process. Calls from the program are recognised by their return addresses.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The C library's allocator, under the names that are available when the usual ones are replaced.
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *bytes, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static uintptr_t base, first, last; // base address and code range of the program; 0 until found
static long fail_at, fail_from;
static atomic_long count;

static int find_program(struct dl_phdr_info *program, size_t size, void *context) {
    (void)size;
    (void)context;
    for (int i = 0; i < program->dlpi_phnum; i++)
        if (program->dlpi_phdr[i].p_type == PT_LOAD && program->dlpi_phdr[i].p_flags & PF_X) {
            base = program->dlpi_addr;
            first = base + program->dlpi_phdr[i].p_vaddr;
            last = first + program->dlpi_phdr[i].p_memsz;
        }
    return 1; // the first entry is the program
}

static long number_of(const char *name) {
    const char *text = getenv(name);
    return text ? strtol(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void begin(void) {
    fail_at = number_of("FAIL_AT");
    fail_from = number_of("FAIL_FROM");
    unsetenv("LD_PRELOAD"); // programs that this program starts are not affected
    dl_iterate_phdr(find_program, NULL);
}

__attribute__((destructor)) static void end(void) {
    const char *name = getenv("COUNT_FILE");
    last = 0;
    FILE *file = name ? fopen(name, "w") : NULL;
    if (file) {
        fprintf(file, "%ld\n", (long)count);
        fclose(file);
    }
}

static int fails(const void *caller) {
    uintptr_t from = (uintptr_t)caller;
    if (from < first || from >= last)
        return 0;
    long number = atomic_fetch_add(&count, 1) + 1;
    if (number != fail_at && (fail_from == 0 || number < fail_from))
        return 0;
    if (getenv("FAIL_TELL"))
        fprintf(stderr, "allocation %ld: called from %#lx\n", number, (unsigned long)(from - base));
    errno = ENOMEM;
    return 1;
}

#define FAILS fails(__builtin_return_address(0))

// The following functions replace those of the C library.
#pragma GCC visibility push(default)

void *malloc(size_t size) {
    return FAILS ? NULL : __libc_malloc(size);
}

void *calloc(size_t elements, size_t size) {
    return FAILS ? NULL : __libc_calloc(elements, size);
}

void *realloc(void *bytes, size_t size) {
    return FAILS ? NULL : __libc_realloc(bytes, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return FAILS ? NULL : __libc_memalign(alignment, size);
}

// Functions of the C library that allocate internally.

char *strdup(const char *text) {
    size_t size = strlen(text) + 1;
    char *copy = FAILS ? NULL : __libc_malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

char *strndup(const char *text, size_t max_length) {
    size_t length = strnlen(text, max_length);
    char *copy = FAILS ? NULL : __libc_malloc(length + 1);
    if (!copy)
        return NULL;
    copy[length] = 0;
    return memcpy(copy, text, length);
}

// Looks up the C library's version of a function.
#define REAL(function, real)                                                                                           \
    __typeof__(function) *real;                                                                                        \
    *(void **)&real = dlsym(RTLD_NEXT, #function)

DIR *opendir(const char *name) {
    REAL(opendir, real);
    return FAILS ? NULL : real(name);
}

DIR *fdopendir(int descriptor) {
    REAL(fdopendir, real);
    return FAILS ? NULL : real(descriptor);
}

char *realpath(const char *name, char *resolved) {
    REAL(realpath, real);
    return !resolved && FAILS ? NULL : real(name, resolved);
}

char *getcwd(char *buffer, size_t size) {
    REAL(getcwd, real);
    return !buffer && FAILS ? NULL : real(buffer, size);
}

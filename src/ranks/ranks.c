// ranks.c: see ranks.h. Messages between two ranks arrive in the order in which they were sent, as MPI has it.
#include "ranks/ranks.h"

#include <fcntl.h>
#include <mpi.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/cpu.h"
#include "cli/mail.h"
#include "petri.h"

// A message on its way, which takes its numbers along.
typedef struct Sending {
    double *numbers;
    MPI_Request request;
} Sending;

typedef struct Ranks {
    PetriRanks as_options;
    Mail mail;
    Sending *sendings;
    size_t count;
    size_t room;
    double *numbers; // of a message that comes
    size_t numbers_room;
    bool near;      // all are on one machine
    double *common; // memory that all of them see
    size_t common_room;
    int patience; // how often it is looked for what should be there soon before others may have the processor
} Ranks;

static Ranks ranks;                // of the process, as MPI is
static volatile sig_atomic_t left; // a signal has come: nobody is waited for

static void pack(double *to, const double *numbers, size_t runs, size_t length, size_t stride) {
    for (size_t k = 0; k < runs; k++) {
        memcpy(to + k * length, numbers + k * stride, length * sizeof *to);
    }
}

static double *make_room(size_t count) {
    if (ranks.numbers_room < count) {
        ranks.numbers_room = count;
        ranks.numbers = memory_resized(ranks.numbers, count * sizeof *ranks.numbers);
    }
    return ranks.numbers;
}

static void unpack(double *numbers, size_t runs, size_t length, size_t stride) {
    for (size_t k = 0; k < runs; k++) {
        memcpy(numbers + k * stride, ranks.numbers + k * length, length * sizeof *numbers);
    }
}

static void send_numbers(void *host, int to, const double *numbers, size_t runs, size_t length, size_t stride) {
    (void)host;
    if (left) {
        return;
    }
    if (ranks.count == ranks.room) {
        ranks.room = 2 * ranks.room + 16;
        ranks.sendings = memory_resized(ranks.sendings, ranks.room * sizeof *ranks.sendings);
    }
    Sending *sending = &ranks.sendings[ranks.count++];
    sending->numbers = memory_resized(NULL, runs * length * sizeof *numbers);
    pack(sending->numbers, numbers, runs, length, stride);
    MPI_Isend(sending->numbers, (int)(runs * length), MPI_DOUBLE, to, 0, MPI_COMM_WORLD, &sending->request);
}

static void leave(void) {
    left = 1;
}

// Waits for the others, but not for ever. False if the request was given up.
static bool wait_for(MPI_Request *request) {
    int done = 0, looks = 0;
    while (MPI_Test(request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && !done && !left) {
        if (looks < ranks.patience) {
            looks++;
        } else {
            sched_yield();
        }
    }
    return done;
}

static void receive_numbers(void *host, int from, double *numbers, size_t runs, size_t length, size_t stride) {
    (void)host;
    double *came = make_room(runs * length);
    MPI_Request request;
    if (left == 0) {
        MPI_Irecv(came, (int)(runs * length), MPI_DOUBLE, from, 0, MPI_COMM_WORLD, &request);
    }
    if (left || !wait_for(&request)) {
        memset(came, 0, runs * length * sizeof *came);
    }
    unpack(numbers, runs, length, stride);
}

static void wait_for_sendings(void) {
    while (ranks.count > 0) {
        Sending *sending = &ranks.sendings[--ranks.count];
        if (!left && wait_for(&sending->request)) {
            free(sending->numbers);
        }
    }
}

static void spread_numbers(void *host, int from, double *numbers, size_t runs, size_t length, size_t stride) {
    (void)host;
    wait_for_sendings();
    double *all = make_room(runs * length);
    if (ranks.as_options.rank == from) {
        pack(all, numbers, runs, length, stride);
    }
    MPI_Request request;
    if (left == 0) {
        MPI_Ibcast(all, (int)(runs * length), MPI_DOUBLE, from, MPI_COMM_WORLD, &request);
    }
    if (left || !wait_for(&request)) {
        memset(all, 0, runs * length * sizeof *all);
    }
    if (ranks.as_options.rank != from) {
        unpack(numbers, runs, length, stride);
    }
}

static void gather_numbers(void *host, double *numbers, const size_t *starts) {
    (void)host;
    wait_for_sendings();
    int count = ranks.as_options.count, *lengths = memory_resized(NULL, 2 * (size_t)count * sizeof *lengths);
    for (int r = 0; r < count; r++) {
        lengths[r] = (int)(starts[r + 1] - starts[r]);
        lengths[count + r] = (int)starts[r];
    }
    MPI_Request request;
    if (left == 0) {
        MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, numbers, lengths, lengths + count, MPI_DOUBLE,
                        MPI_COMM_WORLD, &request);
        wait_for(&request);
    }
    free(lengths);
}

static void find_most(void *host, double *numbers, size_t count) {
    (void)host;
    wait_for_sendings();
    MPI_Request request;
    if (left == 0) {
        MPI_Iallreduce(MPI_IN_PLACE, numbers, (int)count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &request);
        wait_for(&request);
    }
}

static void *map(const char *name, int flags, size_t bytes) {
    void *memory = MAP_FAILED;
    int file = shm_open(name, O_RDWR | flags, S_IRUSR | S_IWUSR);
    // With room for all of it at once: else it would be missing later, where nobody can be told.
    if (file >= 0 && (!(flags & O_CREAT) || posix_fallocate(file, 0, (off_t)bytes) == 0)) {
        memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    }
    if (file >= 0) {
        close(file);
    }
    return memory == MAP_FAILED ? NULL : memory;
}

// Rank 0 makes it; its name is gone as soon as all have it, so that nothing stays behind.
static double *map_common(size_t bytes) {
    static int count;
    char name[64];
    double maker = getpid(), lacks = 0;
    spread_numbers(NULL, 0, &maker, 1, 1, 1);
    snprintf(name, sizeof name, "/petri-%.0f-%d", maker, ++count);
    double *memory = ranks.as_options.rank == 0 ? map(name, O_CREAT | O_EXCL, bytes) : NULL;
    find_most(NULL, &lacks, 1); // it is there, or never will be
    if (ranks.as_options.rank > 0) {
        memory = map(name, 0, bytes);
    }
    lacks = !memory;
    find_most(NULL, &lacks, 1);
    if (ranks.as_options.rank == 0) {
        shm_unlink(name);
    }
    if (memory && lacks > 0) {
        munmap(memory, bytes);
    }
    return lacks > 0 ? NULL : memory;
}

static double *share_memory(void *host, size_t count) {
    (void)host;
    if (ranks.near && ranks.common_room < count) {
        if (ranks.common) {
            munmap(ranks.common, ranks.common_room * sizeof *ranks.common);
        }
        ranks.common_room = count + count / 8; // halos come and go
        ranks.common = map_common(ranks.common_room * sizeof *ranks.common);
        ranks.near = ranks.common;
    }
    return ranks.near ? ranks.common : NULL;
}

enum { NUMBERS, LETTER }; // tags

static void send_letter(int to, const void *bytes, size_t length) {
    MPI_Send(bytes, (int)length, MPI_BYTE, to, LETTER, MPI_COMM_WORLD);
}

static bool take_letter(int *from, Bytes *letter) {
    int there = 0, length = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, LETTER, MPI_COMM_WORLD, &there, &status);
    if (there) {
        MPI_Get_count(&status, MPI_BYTE, &length);
        SCOPED_TEXT bytes = memory_zeroed((size_t)length + 1);
        MPI_Recv(bytes, length, MPI_BYTE, status.MPI_SOURCE, LETTER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        bytes_add(letter, bytes, (size_t)length);
        *from = status.MPI_SOURCE;
    }
    return there;
}

// How many ranks are on this machine.
static int count_neighbours(void) {
    MPI_Comm here;
    int count = 0;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &count);
    MPI_Comm_free(&here);
    return count;
}

// All do the same, so what the others would write is there already.
static void be_quiet(void) {
    int nothing = open("/dev/null", O_RDWR);
    for (int fd = STDIN_FILENO; nothing >= 0 && fd <= STDERR_FILENO; fd++) {
        dup2(nothing, fd);
    }
}

void ranks_begin(Host *host) {
    int given = 0, level = cpu_here.level, least = level;
    MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &given);
    PetriRanks *options = &ranks.as_options;
    *options = (PetriRanks){.send = send_numbers,
                            .receive = receive_numbers,
                            .spread = spread_numbers,
                            .gather = gather_numbers,
                            .most = find_most,
                            .share = share_memory};
    MPI_Comm_rank(MPI_COMM_WORLD, &options->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &options->count);
    // What is worth sharing depends on the processor: all go by the least one.
    MPI_Allreduce(&level, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    host->cpu = cpu_name((CpuLevel)least);
    host->ranks = options;
    host->leave_ranks = leave;
    enum { PATIENCE = 1000 }; // some 100 microseconds
    int neighbours = count_neighbours();
    ranks.patience = neighbours <= cpu_count() ? PATIENCE : 0;
    const char *apart = getenv("PETRI_APART"); // as if each were on a machine of its own
    ranks.near = neighbours == options->count && !(apart && *apart);
    ranks.mail = (Mail){options->rank, options->count, send_letter, take_letter};
    host->mail = &ranks.mail;
    if (options->rank > 0) {
        be_quiet();
    }
}

// A process that ends without MPI_Finalize makes mpirun end all, with its status: those that wait for it, too. What
// fails here mostly fails everywhere, and then rank 0 is to say so first; its end interrupts the sleep.
void ranks_end(int status) {
    enum { SECONDS = 5 };
    if (status != STATUS_DONE) {
        if (ranks.as_options.rank > 0) {
            sleep(SECONDS);
        }
        _exit(status);
    }
    wait_for_sendings();
    free(ranks.sendings);
    free(ranks.numbers);
    MPI_Finalize();
}

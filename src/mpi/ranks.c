// ranks.c: the callbacks of PetriRanks over MPI (ranks.h). MPI delivers messages between two ranks in the order in
// which they were sent.
#include "mpi/ranks.h"

#include "base/cpu.h"
#include "base/os.h"
#include "cli/mpi_channel.h"
#include "petri-ranks.h"

#include <fcntl.h>
#include <mpi.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

// A message that is being sent, with a copy of its numbers.
typedef struct PendingSend {
    double *numbers;
    MPI_Request request;
} PendingSend;

typedef struct Ranks {
    PetriRanks as_options;
    MpiChannel channel;
    PendingSend *pending; // sends that may still be in progress
    size_t count;         // number of elements of `pending`
    size_t pending_capacity;
    double *numbers; // buffer for received or broadcast numbers
    size_t numbers_capacity;
    bool same_node; // true if all ranks are on one machine and can share memory
    double *shared; // memory that all ranks share; NULL: none yet
    size_t shared_capacity;
    int max_spins; // number of polls before a waiting rank yields its processor
} Ranks;

static Ranks ranks;                             // the only instance, because MPI also has one state per process
static volatile sig_atomic_t waiting_cancelled; // set to true by a signal handler to stop waiting for other ranks

static void pack_blocks(double *to, const double *numbers, size_t count, size_t block_length, size_t stride) {
    for (size_t k = 0; k < count; k++)
        memcpy(to + k * block_length, numbers + k * stride, block_length * sizeof *to);
}

static double *reserve_numbers(size_t count) {
    if (ranks.numbers_capacity < count) {
        ranks.numbers_capacity = count;
        ranks.numbers = memory_realloc(ranks.numbers, count * sizeof *ranks.numbers);
    }
    return ranks.numbers;
}

static void unpack_blocks(double *numbers, size_t count, size_t block_length, size_t stride) {
    for (size_t k = 0; k < count; k++)
        memcpy(numbers + k * stride, ranks.numbers + k * block_length, block_length * sizeof *numbers);
}

static void send_numbers(void *user_data, int to, const double *numbers, size_t count, size_t block_length,
                         size_t stride) {
    (void)user_data;
    if (waiting_cancelled)
        return;
    if (ranks.count == ranks.pending_capacity) {
        ranks.pending_capacity = 2 * ranks.pending_capacity + 16;
        ranks.pending = memory_realloc(ranks.pending, ranks.pending_capacity * sizeof *ranks.pending);
    }
    PendingSend *pending = &ranks.pending[ranks.count++];
    pending->numbers = memory_realloc(NULL, count * block_length * sizeof *numbers);
    pack_blocks(pending->numbers, numbers, count, block_length, stride);
    MPI_Isend(pending->numbers, (int)(count * block_length), MPI_DOUBLE, to, 0, MPI_COMM_WORLD, &pending->request);
}

static void cancel_waiting(void) {
    waiting_cancelled = 1;
}

// Waits until the request is done. Returns false if waiting was cancelled.
static bool wait_for(MPI_Request *request) {
    int done = 0, spins = 0;
    while (MPI_Test(request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && !done && !waiting_cancelled)
        if (spins < ranks.max_spins)
            spins++;
        else
            sched_yield();
    return done;
}

static void receive_numbers(void *user_data, int from, double *numbers, size_t count, size_t block_length,
                            size_t stride) {
    (void)user_data;
    double *received = reserve_numbers(count * block_length);
    MPI_Request request;
    if (waiting_cancelled == 0)
        MPI_Irecv(received, (int)(count * block_length), MPI_DOUBLE, from, 0, MPI_COMM_WORLD, &request);
    if (waiting_cancelled || !wait_for(&request))
        memset(received, 0, count * block_length * sizeof *received);
    unpack_blocks(numbers, count, block_length, stride);
}

static void wait_for_sends(void) {
    while (ranks.count > 0) {
        PendingSend *pending = &ranks.pending[--ranks.count];
        if (!waiting_cancelled && wait_for(&pending->request))
            free(pending->numbers);
    }
}

static void broadcast_numbers(void *user_data, int from, double *numbers, size_t count, size_t block_length,
                              size_t stride) {
    (void)user_data;
    wait_for_sends();
    double *all = reserve_numbers(count * block_length);
    if (ranks.as_options.rank == from)
        pack_blocks(all, numbers, count, block_length, stride);
    MPI_Request request;
    if (waiting_cancelled == 0)
        MPI_Ibcast(all, (int)(count * block_length), MPI_DOUBLE, from, MPI_COMM_WORLD, &request);
    if (waiting_cancelled || !wait_for(&request))
        memset(all, 0, count * block_length * sizeof *all);
    if (ranks.as_options.rank != from)
        unpack_blocks(numbers, count, block_length, stride);
}

static void allgather_numbers(void *user_data, double *numbers, const size_t *starts) {
    (void)user_data;
    wait_for_sends();
    int count = ranks.as_options.rank_count, *lengths = memory_realloc(NULL, 2 * (size_t)count * sizeof *lengths);
    for (int r = 0; r < count; r++) {
        lengths[r] = (int)(starts[r + 1] - starts[r]);
        lengths[count + r] = (int)starts[r];
    }
    MPI_Request request;
    if (waiting_cancelled == 0) {
        MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, numbers, lengths, lengths + count, MPI_DOUBLE,
                        MPI_COMM_WORLD, &request);
        wait_for(&request);
    }
    free(lengths);
}

static void reduce_max(void *user_data, double *numbers, size_t count) {
    (void)user_data;
    wait_for_sends();
    MPI_Request request;
    if (waiting_cancelled == 0) {
        MPI_Iallreduce(MPI_IN_PLACE, numbers, (int)count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &request);
        wait_for(&request);
    }
}

static void *map_memory(const char *name, int flags, size_t bytes) {
    void *memory = MAP_FAILED;
    int file = shm_open(name, O_RDWR | flags, S_IRUSR | S_IWUSR);
    // Allocates all memory now, because a lack of memory later would cause a bus error.
    if (file >= 0 && (!(flags & O_CREAT) || posix_fallocate(file, 0, (off_t)bytes) == 0))
        memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0)
        close(file);
    return memory == MAP_FAILED ? NULL : memory;
}

// Maps memory that rank 0 creates. The name of the memory is removed as soon as all ranks have mapped it, so that
// nothing is left behind. Returns NULL on all ranks if one fails.
static double *map_shared(size_t bytes) {
    static int count;
    char name[64];
    double maker = getpid(), missing = 0;
    broadcast_numbers(NULL, 0, &maker, 1, 1, 1);
    snprintf(name, sizeof name, "/petri-%.0f-%d", maker, ++count);
    double *memory = ranks.as_options.rank == 0 ? map_memory(name, O_CREAT | O_EXCL, bytes) : NULL;
    reduce_max(NULL, &missing, 1); // a barrier: rank 0 has created the memory or failed
    if (ranks.as_options.rank > 0)
        memory = map_memory(name, 0, bytes);
    missing = !memory;
    reduce_max(NULL, &missing, 1);
    if (ranks.as_options.rank == 0)
        shm_unlink(name);
    if (memory && missing > 0)
        munmap(memory, bytes);
    return missing > 0 ? NULL : memory;
}

static double *alloc_shared(void *user_data, size_t count) {
    (void)user_data;
    if (ranks.same_node && ranks.shared_capacity < count) {
        if (ranks.shared)
            munmap(ranks.shared, ranks.shared_capacity * sizeof *ranks.shared);
        ranks.shared_capacity = count + count / 8; // spare capacity, because the size varies between frames
        ranks.shared = map_shared(ranks.shared_capacity * sizeof *ranks.shared);
        ranks.same_node = ranks.shared;
    }
    return ranks.same_node ? ranks.shared : NULL;
}

enum { NUMBERS, MESSAGE }; // message tags

static void send_message(int to, const void *bytes, size_t length) {
    MPI_Send(bytes, (int)length, MPI_BYTE, to, MESSAGE, MPI_COMM_WORLD);
}

static bool receive_message(int *from, Text *message) {
    int there = 0, length = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MESSAGE, MPI_COMM_WORLD, &there, &status);
    if (there) {
        MPI_Get_count(&status, MPI_BYTE, &length);
        SCOPED_STRING bytes = memory_calloc((size_t)length + 1);
        MPI_Recv(bytes, length, MPI_BYTE, status.MPI_SOURCE, MESSAGE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        text_add(message, (Str){bytes, (size_t)length});
        *from = status.MPI_SOURCE;
    }
    return there;
}

// Returns the number of ranks on this machine.
static int count_node_ranks(void) {
    MPI_Comm here;
    int count = 0;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &count);
    MPI_Comm_free(&here);
    return count;
}

// Redirects the standard streams to /dev/null, because all ranks would print the same.
static void silence_output(void) {
    int nothing = open("/dev/null", O_RDWR);
    for (int fd = STDIN_FILENO; nothing >= 0 && fd <= STDERR_FILENO; fd++)
        dup2(nothing, fd);
}

void ranks_begin(CommandContext *context) {
    int thread_level = 0, level = cpu_detected.level, min_level = level;
    MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &thread_level);
    PetriRanks *options = &ranks.as_options;
    *options = (PetriRanks){.size = sizeof *options,
                            .send = send_numbers,
                            .receive = receive_numbers,
                            .broadcast = broadcast_numbers,
                            .allgatherv = allgather_numbers,
                            .allreduce_max = reduce_max,
                            .alloc_shared = alloc_shared};
    MPI_Comm_rank(MPI_COMM_WORLD, &options->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &options->rank_count);
    // All ranks must make the same decisions, some of which depend on the CPU level. So all use the lowest level.
    MPI_Allreduce(&level, &min_level, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    context->cpu = cpu_name((CpuLevel)min_level);
    context->ranks = options;
    context->leave_ranks = cancel_waiting;
    enum { MAX_SPINS = 1000 }; // about 100 µs
    int node_ranks = count_node_ranks();
    ranks.max_spins = node_ranks <= os_processor_count() ? MAX_SPINS : 0;
    const char *no_shared_memory =
        getenv("PETRI_NO_SHARED_MEMORY"); // for tests: as if each rank were on a separate machine
    ranks.same_node = node_ranks == options->rank_count && !(no_shared_memory && *no_shared_memory);
    ranks.channel = (MpiChannel){options->rank, options->rank_count, send_message, receive_message};
    context->channel = &ranks.channel;
    if (options->rank > 0)
        silence_output();
}

// If a process exits without MPI_Finalize, mpirun terminates all other ranks and exits with the status of this process.
// Most failures happen on all ranks. Then the ranks above 0 sleep, so that rank 0 can report the error first. mpirun
// terminates them when rank 0 exits.
void ranks_end(int status) {
    enum { GRACE_SECONDS = 5 };
    if (status != STATUS_DONE) {
        if (ranks.as_options.rank > 0)
            sleep(GRACE_SECONDS);
        _exit(status);
    }
    wait_for_sends();
    free(ranks.pending);
    free(ranks.numbers);
    MPI_Finalize();
}

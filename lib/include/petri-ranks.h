// petri-ranks.h: the part of libpetri for several processes that run one script together. The rules of petri.h apply.
#ifndef PETRI_RANKS_H
#define PETRI_RANKS_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// Communication between processes (ranks) that run one script together, for example over MPI. Each rank has its own
// session and makes the same calls. The ranks divide the work of large systems. All ranks get the same results as a
// single process, bit for bit.
//
// The functions transfer `count` blocks of `block_length` doubles; consecutive blocks start `stride` doubles apart, as
// in MPI_Type_vector. Messages between two ranks must arrive in the order in which they were sent. After
// petri_interrupt has been called on all ranks, the functions may return without waiting. Numbers that were not
// received must then be set to 0.
struct PetriRanks {
    size_t size;    // sizeof(PetriRanks)
    int rank;       // number of this process, from 0
    int rank_count; // number of processes
    // Smallest number of particle pairs for which the work is divided; 0 (the default): chosen by the library.
    uint64_t min_pairs;
    void *user_data; // passed to the functions
    // Sends numbers to rank `to`. Copies them and returns without waiting for the receiver.
    void (*send)(void *user_data, int to, const double *numbers, size_t count, size_t block_length, size_t stride);
    // Waits for numbers from rank `from`.
    void (*receive)(void *user_data, int from, double *numbers, size_t count, size_t block_length, size_t stride);
    // Copies the numbers of rank `from` to all ranks.
    void (*broadcast)(void *user_data, int from, double *numbers, size_t count, size_t block_length, size_t stride);
    // Copies the elements starts[r] to starts[r + 1] - 1 of each rank r to all ranks.
    void (*allgatherv)(void *user_data, double *numbers, const size_t *starts);
    // Replaces each number by its maximum over all ranks. No number is NaN.
    void (*allreduce_max)(void *user_data, double *numbers, size_t count);
    // Returns memory for `count` doubles that all ranks share, if they run on one machine. Valid until the next call of
    // alloc_shared. All ranks call it together, and all get NULL if the memory is not available. If shared memory is
    // not supported, set alloc_shared to NULL on all ranks. Data that a rank writes before broadcast, allgatherv or
    // allreduce_max must be visible to all ranks after that call.
    double *(*alloc_shared)(void *user_data, size_t count);
};

// How the ranks (PetriOptions.ranks) divide the work of a system.
typedef enum PetriDecomposition {
    PETRI_REPLICATED,        // not divided, because the system or its forces are small: each rank computes everything
    PETRI_FORCE_DECOMPOSED,  // forces of unlimited range: each rank computes some blocks of pairs
    PETRI_DOMAIN_DECOMPOSED, // each rank owns the particles of a region
} PetriDecomposition;

// What this rank has communicated for one system so far. A message to all ranks counts once.
typedef struct PetriRankStats {
    PetriDecomposition decomposition; // in the last frame
    uint64_t frames;                  // number of frames with simulation steps
    uint64_t steps;
    uint64_t step_bytes; // bytes that this rank sent during steps
    uint64_t step_messages;
    uint64_t reductions;  // number of allreduce operations; each needs about 2 log2(rank_count) messages
    uint64_t frame_bytes; // bytes that this rank sent at the end of frames, when all ranks receive all particles
    uint64_t own;         // sum over all steps of the number of particles that the rank owns
    uint64_t halo;        // sum over all steps of the number of particles received from other regions
} PetriRankStats;

// Gets the communication statistics of a system. Returns false if there is no such system.
PETRI_API bool petri_rank_stats(PetriSession *session, size_t system, PetriRankStats *stats, size_t size);

#ifdef __cplusplus
}
#endif

#endif

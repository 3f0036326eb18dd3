// mpi_channel.h: messages between the processes that mpirun has started.
//
// They are used for asynchronous work, such as the assignment of sweep runs. PetriRanks has collective operations.
#ifndef PETRI_SRC_MPI_CHANNEL_H
#define PETRI_SRC_MPI_CHANNEL_H

#include "cli/byte_buffer.h"

typedef struct MpiChannel {
    int rank;  // number of this process, from 0
    int count; // number of processes
    // Sends a message. A long message may block until it is received.
    void (*send)(int to, const void *bytes, size_t length);
    // Appends a received message to `message` and sets *from to its sender. Returns false if there is none.
    bool (*receive)(int *from, ByteBuffer *message);
} MpiChannel;

#endif

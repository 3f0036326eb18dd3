// mpi_channel.h: letters between the processes that mpirun has started, for what is not done in step.
#ifndef PETRI_SRC_MPI_CHANNEL_H
#define PETRI_SRC_MPI_CHANNEL_H

#include "cli/byte_buffer.h"

typedef struct Mail {
    int rank; // of this process, from 0
    int count;
    // May wait until the other takes it, if it is long.
    void (*send)(int to, const void *bytes, size_t length);
    // Adds the bytes of a letter that has come; false if none has.
    bool (*receive)(int *from, ByteBuffer *message);
} MpiChannel;

#endif

// mpi_channel.h: messages between the processes that mpirun has started.
//
// The messages are for asynchronous work, such as the assignment of sweep runs. For collective operations, see
// PetriRanks.
#pragma once

#include "cli/memory.h"

typedef struct MpiChannel {
    int rank;  // number of this process, from 0
    int count; // number of processes
    // Sends a message to rank `to`. Can block until that rank has received the message, if the message is long.
    void (*send)(int to, const void *bytes, size_t length);
    // Appends a received message to `message` and sets *from to the rank of its sender. Returns false, without waiting,
    // if no message has arrived.
    bool (*receive)(int *from, Text *message);
} MpiChannel;

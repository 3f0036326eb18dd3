// ranks.c: see ranks.h.
//
// Rank 0 chooses the segments and sends them, so that all ranks divide the same sample. It then receives all results,
// of which the first segment that differs counts.
#include "archive/ranks.h"

#include "cli/mpi_channel.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

// The result of a rank. The bytes of the details follow it in a message.
typedef struct RankResult {
    bool failed;
    bool differs;
    bool has_digests;
    size_t differs_at;
    int64_t frames;
    int64_t frame;
    uint8_t digests[2][DIGEST_BYTES];
} RankResult;

// Waits for a message. Returns the rank of its sender.
static int wait_for_message(const MpiChannel *channel, Text *message) {
    int from = 0;
    while (!channel->receive(&from, message))
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    return from;
}

bool ranks_is_first(const Verification *verification) {
    return !verification->context->channel || verification->context->channel->rank == 0;
}

void ranks_divide(Verification *verification) {
    const MpiChannel *channel = verification->context->channel;
    if (!channel)
        return;
    verification->next = (size_t)channel->rank;
    verification->stride = (size_t)channel->count;
    size_t size = verification->chosen * sizeof *verification->segments;
    for (int rank = 1; channel->rank == 0 && rank < channel->count; rank++)
        channel->send(rank, verification->segments, size);
    if (channel->rank == 0)
        return;
    SCOPED_TEXT message = {0};
    wait_for_message(channel, &message);
    verification->chosen = message.len / sizeof *verification->segments;
    verification->segments = memory_realloc(verification->segments, message.len + 1);
    memcpy(verification->segments, message.bytes, message.len);
}

static void send_result(const Verification *verification) {
    const SegmentResult *found = &verification->result;
    RankResult result;
    memset(&result, 0, sizeof result); // also the padding
    result.failed = verification->failed;
    result.differs = verification->differs;
    result.has_digests = found->has_digests;
    result.differs_at = verification->differs_at;
    result.frames = verification->frames;
    result.frame = found->frame;
    memcpy(result.digests, found->digests, sizeof result.digests);
    SCOPED_TEXT message = {0};
    text_add(&message, (Str){(const char *)&result, sizeof result});
    text_add(&message, text_str(&found->details));
    verification->context->channel->send(0, message.bytes, message.len);
}

static void add_result(Verification *verification, int rank, const Text *packet) {
    RankResult result;
    memcpy(&result, packet->bytes, sizeof result);
    verification->frames += result.frames;
    if (result.failed && !verification->failed)
        message("rank %d cannot verify its segments; verify the archive without mpirun for the reason", rank);
    verification->failed = verification->failed || result.failed;
    if (!result.differs || (verification->differs && verification->differs_at < result.differs_at))
        return;
    SegmentResult *found = &verification->result;
    verification->differs = true;
    verification->differs_at = result.differs_at;
    found->frame = result.frame;
    found->has_digests = result.has_digests;
    memcpy(found->digests, result.digests, sizeof found->digests);
    text_free(&found->details);
    text_add(&found->details, (Str){packet->bytes + sizeof result, packet->len - sizeof result});
}

void ranks_combine(Verification *verification) {
    const MpiChannel *channel = verification->context->channel;
    if (channel && channel->rank > 0) {
        send_result(verification);
        verification->failed = verification->differs = false;
        return;
    }
    for (int rank = 1; channel && rank < channel->count; rank++) {
        SCOPED_TEXT packet = {0};
        int from = wait_for_message(channel, &packet);
        add_result(verification, from, &packet);
    }
}

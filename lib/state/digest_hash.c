// digest_hash.c: the loop over the bytes of a hash, compiled once per instruction set; see digest_hash.h.
#include "state/digest_hash.h"

void DIGEST_UPDATE(XXH3_state_t *hash, const void *bytes, size_t size) {
    XXH3_128bits_update(hash, bytes, size);
}

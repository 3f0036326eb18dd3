// digest.h: the digest of the state dictionary (spec digest.md).
//
// A digest is a hash of all keys and values. It is computed in three steps, of which the second can be divided among
// threads:
//
//     state_digest_begin(state, &numbers)           once
//     state_digest_part(state, part, parts)         for part = 0 to parts - 1, in any order, on any thread
//     state_digest_end(state, digest)               once
//
// The order of the keys and the digest of keys and lengths are cached. They are computed again only if a key was added
// or removed, or if the length of a value has changed. Otherwise only the numbers of the values are hashed.
#pragma once

#include "state/state.h"

enum { STATE_DIGEST_SIZE = 16 };

// Returns true if state_digest_begin has to process all keys, not only new ones.
bool state_digest_is_stale(const State *state);
// Begins a digest. Sets *numbers to the number of numbers in all values. Returns false if out of memory. The state must
// not change before state_digest_end.
bool state_digest_begin(State *state, uint64_t *numbers);
// Hashes one of `parts` equal parts of the numbers.
void state_digest_part(State *state, int part, int parts);
// Sets `digest` to the digest.
void state_digest_end(const State *state, uint8_t digest[STATE_DIGEST_SIZE]);

// mirror.h: who owns the positions and velocities of a `!physics` system.
//
// They are in two places. The engine has a row of numbers for each particle (physics/system.h), from which each frame
// starts and into which its results go. The state has an entry for each position and for each velocity, which scripts
// read, and which a host or another node may overwrite. The mirror keeps row and entry alike, without copying where
// that can be had, and tells when the engine's description of the last frame can serve the next one.
//
// Who owns the numbers:
//   - An entry of two numbers or more *borrows* the engine's row: it points there (state.h, lenders), so a result is in
//     the state as soon as it is in the row. Whoever else writes to such an entry gives it numbers of its own, and
//     thereby *disturbs* the lender: the row is wrong from then on.
//   - Everything else owns a *copy*: entries of one number, which a value holds itself; those of anchors, which are
//     few and stand where their attributes say; all of a system with two particles for one key, where the later one
//     wins; those of a system that is left out of a frame, or goes away.
// Rows stay where they are until phys_begin, and readable until the phys_begin after that. So an entry that borrows
// from the description before either borrows from the new one or gets a copy, before mirror_store ends.
//
// What may be stored: a result that is finite, and that does not equal what is stored (0 does not become -0). Both
// rules hold for rows (PhysTime.keep_last_finite) as they do for copies (numbers_finite; state_slot_set), or a
// borrowing entry would show what a copy must not hold. An entry that the state does not have yet is *missing*: the row
// holds the attribute's number then, which is no result, so the entry borrows from the first finite result on. Missing
// entries are counted, for somebody may write one between two frames without disturbing anyone.
//
// States of a mirror:
//
//                mirror_open                          mirror_store: all is alike
//      STALE ─────────────────▶ OPEN ─────────────────────────────────────────────▶ CURRENT
//       ▲ ▲                    │  ▲ │                                               │  ▲ │
//       │ └────────────────────┘  └─┘ mirror_open: the update before broke off,     │  └─┘ mirror_reuse, mirror_store:
//       │   mirror_store:             so entries get copies first                   │      the same particles
//       │   memory, keys or numbers do not match                                    │
//       └───────────────────────────────────────────────────────────────────────────┘
//         mirror_reuse: disturbed, the run restarted, other particles, or an update that breaks off;
//         a mistake in the tree, which is to be reported in each frame; the system left out of a frame
//
//   STALE    The tree must be read from scratch, with positions and velocities from the state, which is always right.
//   OPEN     A description was begun and not finished: some entries borrow from the one before.
//   CURRENT  Rows and entries are alike, and so are the description and the last frame's tree: only what the next
//            tree changes need be told to the engine, which for the same tree is nothing.
#ifndef PETRI_SCENE_MIRROR_H
#define PETRI_SCENE_MIRROR_H

#include "physics/system.h"
#include "state/state.h"

typedef enum MirrorState { MIRROR_STALE, MIRROR_OPEN, MIRROR_CURRENT } MirrorState;

// All zeros is a mirror of no particles. Slots come in pairs, position and velocity, by particle handle.
typedef struct Mirror {
    MirrorState state;
    StateOwner owner; // 0: none yet, or no memory for one
    StateSlot *slots; // of the particles and anchors in the last tree
    uint32_t slot_count;
    uint32_t slot_capacity;
    StateSlot *last_slots; // while OPEN: of the last tree that was read whole
    uint32_t last_count;
    uint32_t last_capacity;
    uint32_t *anchors; // handles, ascending
    uint32_t anchor_count;
    uint32_t anchor_capacity;
    uint32_t missing; // entries that the state does not have yet
    double *ids;      // of all particles, for those who ask (scene_view_ids)
    uint32_t id_capacity;
    bool ids_cached; // they were looked at since the last tree was read whole
    bool ids_single; // … and each is one number, which is there
} Mirror;

typedef struct PhysicsTree PhysicsTree;

void mirror_free(Mirror *mirror);
// Gives a new mirror the particles of an old one; false if memory is used up.
bool mirror_restore(Mirror *mirror, const StateSlot *slots, uint32_t count);
// The system is left out of a frame, or goes away: its entries stay, with copies, and it has no particles.
void mirror_leave(Mirror *mirror, State *state);
// The run restarts: removes the entries.
void mirror_remove(Mirror *mirror, State *state);

// Begins a description from scratch; what entries borrow stays readable.
void mirror_open(PhysicsTree *tree);
// Adds the particle or anchor that comes next; they count when all are there (slot_count). False if memory is used up.
bool mirror_add(PhysicsTree *tree, StateSlot position, StateSlot velocity, bool anchor);
// The vector with which a particle begins the frame: the state's, if the run goes on and it has one of n numbers, else
// the attribute's (*from_attribute). One number is copied to *single.
PhysVector mirror_start(const PhysicsTree *tree, StateSlot slot, PhysVector attribute, double *single,
                        bool *from_attribute);
// Removes the entries of particles that were in the last tree and are not in this one, except entries that a particle
// of this tree also has: $(prefix;id;:velocity) may be the position of another particle.
void mirror_remove_vanished(const PhysicsTree *tree);

// Can the description be brought up to date with this frame's tree? If so, it counts as STALE until mirror_store.
bool mirror_reuse(PhysicsTree *tree);
// Which numbers of a particle the engine has from frames before.
PhysPreserve mirror_preserve(const PhysicsTree *tree, uint32_t body);

// Can entries borrow the rows of this tree? If not, results are copied.
bool mirror_can_lend(const PhysicsTree *tree);
// Puts the frame's results into the state; `simulated`: there are some.
void mirror_store(PhysicsTree *tree, bool simulated);

#endif

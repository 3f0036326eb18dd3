// mirror.h: synchronises the positions and velocities of a `!physics` system between engine and state.
//
// They are stored in two places. The engine has a row of numbers for each position and each velocity
// (physics/system.h). A frame starts with these numbers and replaces them by its results. The state has an entry for
// each position and each velocity, which scripts read and which a host or another node can overwrite. The mirror keeps
// rows and entries in sync, if possible without copying. It also decides whether the engine's *description* (the
// particles, groups and forces of the last frame's tree) can be used for the next frame.
//
// Ownership of the numbers:
//   - An entry of two or more numbers *references* the engine's row through a pointer (state.h, StateOwner). So a
//     result is in the state as soon as it is in the row. If anything else writes to such an entry, the entry owns the
//     new numbers. Its owner is then marked as *modified*, because the row is out of date.
//   - Every other entry owns a *copy*. These are entries of one number, because the value itself holds the number, and
//     entries of anchors, because anchors are few. If two particles of a system share a key, all entries of the system
//     own copies, and the later particle wins. The entries of a system that is absent from a frame or removed also own
//     copies.
// A row keeps its address until phys_begin starts a new description, and stays readable until the phys_begin after
// that. So before mirror_store returns, each entry that references a row of the previous description is changed: it
// references a row of the new description, or receives a copy of its numbers.
//
// A result is stored only if it is finite and does not equal the stored value (0 does not become -0). Both rules hold
// for rows (PhysTime.keep_last_finite) as well as for copies (numbers_finite; state_slot_set). Otherwise a referencing
// entry could show a value that a copy must not hold.
//
// An entry is *missing* until the state contains it. Until then, its row holds the attribute's value, which is not a
// result. The entry is created when the row receives its first finite result. Missing entries are counted: if the host
// or another node creates one between two frames, the owner does not become modified, but the count changes.
//
// States of a mirror:
//
//                mirror_open                          mirror_store: all in sync
//      STALE ─────────────────▶ OPEN ─────────────────────────────────────────────▶ CURRENT
//       ▲ ▲                    │  ▲ │                                               │  ▲ │
//       │ └────────────────────┘  └─┘ mirror_open: the last update was aborted,     │  └─┘ mirror_reuse, mirror_store:
//       │   mirror_store:             so entries get copies first                   │      the same particles
//       │   out of memory, or keys or numbers do not match                          │
//       └───────────────────────────────────────────────────────────────────────────┘
//         mirror_reuse: other particles, or the update was aborted
//         mirror_remove: the run was restarted
//         mirror_leave: the system is absent from a frame
//         update_system: the tree has a mistake, which must be reported in each frame
//
//   If the owner was modified, or the number of dimensions has changed, mirror_open goes from CURRENT to OPEN directly.
//
//   STALE    The tree must be read from scratch, with positions and velocities from the state, which is authoritative.
//   OPEN     A description was begun and not finished: some entries reference the previous description.
//   CURRENT  Rows and entries are in sync, and the description matches the last frame's tree. Only differences of the
//            next tree must be passed to the engine: none if the tree is the same.
#pragma once

#include "physics/system.h"
#include "state/state.h"

typedef enum MirrorState { MIRROR_STALE, MIRROR_OPEN, MIRROR_CURRENT } MirrorState;

// A zeroed struct is a mirror without particles. Slots are in pairs, position and velocity, by particle handle.
typedef struct Mirror {
    MirrorState state;
    StateOwner owner; // 0: none yet, or out of memory
    StateSlot *slots; // slots of the particles and anchors in the last tree
    uint32_t slot_count;
    uint32_t slot_capacity;
    StateSlot *last_slots; // while OPEN: slots of the last tree that was read completely
    uint32_t last_count;
    uint32_t last_capacity;
    uint32_t *anchors; // handles of the anchors, ascending
    uint32_t anchor_count;
    uint32_t anchor_capacity;
    uint32_t missing; // number of entries that the state does not have yet
    double *ids;      // ids of all particles, for scene_view_ids
    uint32_t id_capacity;
    bool ids_cached; // true if `ids_single` and `ids` are valid for the current tree
    bool ids_single; // true if every id is a single number; otherwise `ids` is unspecified
} Mirror;

typedef struct PhysicsTree PhysicsTree;

void mirror_free(Mirror *mirror);
// Copies the slots of saved particles to a new mirror. Returns false if out of memory.
bool mirror_restore(Mirror *mirror, const StateSlot *slots, uint32_t count);
// Removes all particles from the mirror of a system that is absent from a frame or removed. The entries remain in the
// state as copies.
void mirror_leave(Mirror *mirror, State *state);
// Removes the entries from the state when a run restarts.
void mirror_remove(Mirror *mirror, State *state);

// Begins a description from scratch. Referenced rows remain readable.
void mirror_open(PhysicsTree *tree);
// Adds the next particle or anchor. physics_read_bodies sets slot_count when all are added. Returns false if out of
// memory.
bool mirror_add(PhysicsTree *tree, StateSlot position, StateSlot velocity, bool anchor);
// Returns the vector with which a particle starts the frame. This is the stored vector if the run continues and the
// vector has the right length. Otherwise it is `attribute`, and *from_attribute is true. A stored vector of one number
// is copied to *single.
PhysVector mirror_start(const PhysicsTree *tree, StateSlot slot, PhysVector attribute, double *single,
                        bool *from_attribute);
// Removes the entries of particles that are no longer in the tree, except keys that another particle uses. For example,
// $(prefix;id;:velocity) can be the key of another particle's position.
void mirror_remove_vanished(const PhysicsTree *tree);

// Returns true if the description can be updated to this frame's tree. If so, the mirror is STALE until mirror_store.
bool mirror_reuse(PhysicsTree *tree);
// Returns whether the engine keeps the position and the velocity of a particle from earlier frames. It keeps those that
// have an entry in the state.
PhysPreserve mirror_preserve(const PhysicsTree *tree, uint32_t body);

// Returns true if rows of this tree can be *lent*: entries can reference them. If not, results are copied.
bool mirror_can_lend(const PhysicsTree *tree);
// Stores the frame's results in the state. `simulated` is false if nothing was simulated, so that there are no new
// results.
void mirror_store(PhysicsTree *tree, bool simulated);

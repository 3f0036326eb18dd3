// particle.c: the description of a particle for the page: entries of the state, forces, and its place in the script.
#include "cli/memory.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "web/host.h"

#include <string.h>

static bool is_printed_as(PetriSession *session, PetriValue value, const char *text) {
    const char *own = petri_format_value(session, value);
    return own && strcmp(own, text) == 0;
}

// Finds a system by its name and a particle by its printed id. Returns false if the last frame has no such particle.
static bool find_particle(PetriSession *session, const char *name, const char *id, size_t *number, PetriSystem *system,
                          uint32_t *particle) {
    PetriEvaluation value;
    for (*number = 0; petri_system(session, *number, system, sizeof *system); ++*number) {
        if (strcmp(system->name, name) != 0)
            continue;
        // Most ids are single numbers or symbols, which petri finds without printing all ids.
        if (petri_evaluate(session, id, PETRI_NUL_TERMINATED, &value, sizeof value, NULL, NULL) == PETRI_OK &&
            petri_find_particle(session, *number, (PetriValue){.length = 1, .numbers = &value.number}, particle))
            return true;
        for (*particle = 0; *particle < system->particle_count; ++*particle)
            if (is_printed_as(session, petri_particle_id(session, *number, *particle), id))
                return true;
    }
    return false;
}

// Returns the node below `parent` that makes a particle or anchor with this id; NULL: none.
static const PetriNode *find_node(PetriSession *session, const PetriNode *parent, const char *id) {
    const PetriNode *node, *found = NULL;
    for (uint32_t i = 0; !found && (node = petri_tree_child(parent, i)); i++) {
        const char *kind = petri_tree_kind(node);
        bool is_particle = strcmp(kind, "particle") == 0 || strcmp(kind, "anchor") == 0;
        if (is_particle && is_printed_as(session, petri_tree_get(node, "id"), id))
            return node;
        found = is_particle ? NULL : find_node(session, node, id);
    }
    return found;
}

// Passes the node that makes a particle to host_contribution, without a vector.
static void send_origin(PetriSession *session, const char *name, const char *id) {
    PetriValue tree = petri_tree(session);
    for (uint32_t i = 0; tree.items && i < tree.length; i++) {
        const PetriNode *system = tree.items[i].type == PETRI_NODE ? tree.items[i].as.node : NULL;
        if (!system || strcmp(petri_tree_kind(system), "physics") != 0 ||
            !is_printed_as(session, petri_tree_get(system, "state"), name))
            continue;
        const PetriNode *node = find_node(session, system, id);
        uint32_t line, column;
        const char *file = node ? petri_tree_place(node, &line, &column) : NULL;
        if (file) {
            host_contribution(petri_tree_kind(node), file, line, column, NULL, NULL, 0);
            return;
        }
    }
}

static void send_state(PetriSession *session, const char *name, const char *id, const char *more) {
    SCOPED_TEXT entry = {0};
    SCOPED_TEXT value = {0};
    PetriEvaluation result;
    text_add_format(&entry, "$(%s;%s%s)", name, id, more);
    petri_evaluate(session, entry.bytes, PETRI_NUL_TERMINATED, &result, sizeof result, text_collect, &value);
    host_entry(entry.bytes, NULL, 0, value.len > 0 ? value.bytes : "");
}

// Describes a particle of the last frame: passes to host_contribution the node that makes it, without a vector, and the
// contributions to the force on it in the last step; to host_entry two entries of the state, `sum`, and `note`, the
// reason why something is missing.
EXPORT(PetriStatus, web_describe, PetriSession *session, const char *name, const char *id) {
    size_t number;
    uint32_t particle;
    PetriSystem system;
    send_origin(session, name, id);
    if (!find_particle(session, name, id, &number, &system, &particle)) {
        host_entry("note", NULL, 0, "is not in this frame");
        return PETRI_OK;
    }
    send_state(session, name, id, "");
    send_state(session, name, id, ";:velocity");
    if (system.steps > 0)
        return web_explain(session, number, particle);
    host_entry("note", NULL, 0, "took no step in this frame");
    return PETRI_OK;
}

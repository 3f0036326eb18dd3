// id_numbers.c: see id_numbers.h.
#include "run/id_numbers.h"

#include <string.h>

enum { FIRST_TEXT = -2 }; // number of the first id that is not a whole number

void id_numbers_free(IdNumbers *numbers) {
    texts_free(&numbers->texts);
    hash_index_free(&numbers->index);
}

static bool is_text(const void *owner, uint32_t entry, const void *key) {
    return strcmp(((const IdNumbers *)owner)->texts.items[entry], key) == 0;
}

bool id_numbers_find(IdNumbers *numbers, const char *text, uint32_t *position) {
    uint64_t hash = hash_bytes(0, text, strlen(text));
    *position = hash_index_find(&numbers->index, hash, is_text, numbers, text);
    if (*position != HASH_INDEX_NONE)
        return true;
    *position = (uint32_t)numbers->texts.count;
    if (!hash_index_add(&numbers->index, hash, *position))
        return false;
    texts_add(&numbers->texts, text);
    return true;
}

static bool add_id(IdNumbers *numbers, PetriSession *session, PetriValue value, Text *ids) {
    const double MAX_INTEGER = 9007199254740992; // 2^53; doubles cannot represent every larger integer
    double number = value.length == 1 && value.numbers ? value.numbers[0] : -1;
    int64_t id = number >= 0 && number <= MAX_INTEGER ? (int64_t)number : -1;
    if (id < 0 || (double)id != number) {
        const char *text = petri_format_value(session, value);
        uint32_t position;
        if (!text || !id_numbers_find(numbers, text, &position))
            return false;
        id = FIRST_TEXT - (int64_t)position;
    }
    text_add(ids, (Str){(const char *)&id, sizeof id});
    return true;
}

bool id_numbers_of_system(IdNumbers *numbers, PetriSession *session, size_t number, const PetriSystem *system,
                          Text *ids) {
    PetriColumn column = petri_particle_ids(session, number);
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *id = !column.data ? NULL : column.data + i * column.stride;
        if (!add_id(numbers, session, !id ? petri_particle_id(session, number, i) : (PetriValue){1, id, NULL}, ids))
            return false;
    }
    return true;
}

const char *id_numbers_text(const IdNumbers *numbers, int64_t id) {
    return id > FIRST_TEXT ? NULL : numbers->texts.items[FIRST_TEXT - id];
}

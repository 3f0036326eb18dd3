// complete.c: completion of words at the prompt.
#include "cli/help.h"
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SHOWN = 100, LINE_WIDTH = 78 };

// A word being completed. Candidates that begin with the typed text are added to `found`.
typedef struct Search {
    Prompt *prompt;
    const char *typed;
    size_t length;
    Completion *found;
} Search;

static void add_candidate(Search *search, const char *word) {
    if (strncmp(word, search->typed, search->length) == 0)
        texts_add(&search->found->words, word);
}

static void add_candidate_with(Search *search, const char *before, const char *word, const char *after) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "%s%s%s", before, word, after);
    add_candidate(search, text.bytes);
}

static bool is_word(char c) {
    return isalnum((unsigned char)c) || c == '_' || (unsigned char)c >= 0x80;
}

static void offer_commands(Search *search) {
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
        add_candidate(search, command->name);
}

static void offer_kinds(Search *search) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++)
        add_candidate(search, kind.name);
}

static void offer_names(Search *search) {
    static const char *const words[] = {"let", "func", "import", "for", "if"};
    PetriBuiltin builtin;
    const char *name;
    for (size_t i = 0; (name = petri_visible_name(search->prompt->session, i)); i++)
        add_candidate(search, name);
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        add_candidate(search, builtin.name);
    for (size_t i = 0; search->length > 0 && i < sizeof words / sizeof words[0]; i++)
        add_candidate(search, words[i]);
}

static void offer_attributes(Search *search, const char *kind, size_t length) {
    PetriNodeKind node;
    PetriNodeAttribute attribute;
    for (size_t i = 0; topic_find_kind((Str){kind, length}, &i, &node); i++)
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++)
            add_candidate_with(search, "", attribute.name, "=");
}

// Reads the state's keys from its printed lines, which have the form `KEY = VALUE`.
static void offer_keys(Search *search) {
    SCOPED_TEXT state = {0};
    Str line;
    size_t at = 0;
    petri_print(search->prompt->session, PETRI_PRINT_STATE, text_collect, &state);
    while (text_next_line(&state, &at, &line)) {
        const char *end = line.bytes[0] == '$' ? strstr(line.bytes, " = ") : NULL;
        if (end) {
            SCOPED_STRING key = memory_strndup(line.bytes, (size_t)(end - line.bytes));
            add_candidate(search, key);
        }
    }
}

static void offer_systems(Search *search) {
    PetriSystem system;
    for (size_t i = 0; petri_system(search->prompt->session, i, &system, sizeof system); i++)
        add_candidate(search, system.name);
}

static void offer_files(Search *search) {
    if (search->prompt->host->add_files)
        search->prompt->host->add_files(search->prompt, search->typed, &search->found->words);
}

// Returns the kind of the node to which an attribute at `at` would belong, and sets *length to the length of the kind.
// Returns NULL if no attribute is expected there.
static const char *node_before(const char *line, size_t at, size_t *length) {
    if (at == 0 || !isspace((unsigned char)line[at - 1]))
        return NULL;
    size_t end = at;
    while (end > 0 && isspace((unsigned char)line[end - 1]))
        end--;
    if (end == 0 || strchr("=;+-*/%(,<>$.", line[end - 1]))
        return NULL;
    while (end > 0 && line[end - 1] != '!')
        end--;
    *length = 0;
    while (end > 0 && is_word(line[end + *length]))
        ++*length;
    return *length > 0 ? line + end : NULL;
}

// Returns the start of the unfinished state look-up at the end of the text, such as `$(:cells;1`, or SIZE_MAX if there
// is none.
static size_t lookup_before(const char *line, size_t length) {
    for (size_t at = length; at > 0; at--) {
        char c = line[at - 1];
        if (c == '$')
            return at - 1;
        if (isspace((unsigned char)c) || c == ')')
            break;
    }
    return SIZE_MAX;
}

static void begin_search(Search *search, const char *line, size_t start, size_t length) {
    search->typed = line + start;
    search->length = length - start;
}

static void search_language(Search *search, const char *line, size_t length) {
    size_t kind_length = 0, start = lookup_before(line, length);
    if (start != SIZE_MAX) {
        begin_search(search, line, start, length);
        offer_keys(search);
        return;
    }
    start = length;
    while (start > 0 && is_word(line[start - 1]))
        start--;
    begin_search(search, line, start, length);
    if (start > 0 && line[start - 1] == '!') {
        offer_kinds(search);
        return;
    }
    const char *kind = node_before(line, start, &kind_length);
    if (kind)
        offer_attributes(search, kind, kind_length);
    else if (start == 0 || line[start - 1] != ':')
        offer_names(search);
}

static void offer_parameters(Search *search) {
    PetriParameter parameter;
    for (size_t i = 0; petri_parameter(search->prompt->session, i, &parameter, sizeof parameter) && parameter.settable;
         i++)
        add_candidate(search, parameter.name);
}

// Offers the default, current, smallest and largest value of a parameter.
static void offer_parameter_values(Search *search, const char *name, size_t length) {
    PetriParameter parameter;
    for (size_t i = 0; petri_parameter(search->prompt->session, i, &parameter, sizeof parameter); i++) {
        if (!str_equal(str_from(parameter.name), (Str){name, length}))
            continue;
        const double ends[] = {parameter.min, parameter.max};
        add_candidate(search, parameter.value);
        add_candidate(search, parameter.default_value);
        for (int k = 0; k < 2; k++) {
            char text[40];
            snprintf(text, sizeof text, "%.15g", ends[k]);
            if (isfinite(ends[k]))
                add_candidate(search, text);
        }
    }
}

// Offers the ids of particles, and their keys if there are several systems.
static void offer_ids(Search *search) {
    enum { MAX_IDS = 1000 }; // of each system
    PetriSession *session = search->prompt->session;
    PetriSystem system;
    bool several = petri_system(session, 1, &system, sizeof system);
    for (size_t i = 0; petri_system(session, i, &system, sizeof system); i++)
        for (uint32_t k = 0; k < system.particle_count && k < MAX_IDS; k++) {
            SCOPED_TEXT key = {0};
            particle_add_key(search->prompt, i, &system, k, &key);
            add_candidate(search, key.bytes + strlen(system.name) + 1);
            add_candidate(search, several ? key.bytes : "");
        }
}

static void offer_vectors(Search *search) {
    add_candidate(search, "position=");
    add_candidate(search, "velocity=");
}

static void offer_expressions(Search *search, const Expressions *list) {
    for (size_t i = 0; i < list->count; i++)
        add_candidate(search, list->items[i].typed);
}

static void offer_breaks(Search *search) {
    offer_expressions(search, &search->prompt->breaks);
}

static void offer_watched(Search *search) {
    offer_expressions(search, &search->prompt->watched);
}

static void offer_topics(Search *search) {
    PetriNodeKind kind;
    offer_commands(search);
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++)
        add_candidate_with(search, "!", kind.name, "");
    offer_names(search);
    add_candidate(search, "builtins");
    add_candidate(search, "nodes");
}

// Completes the operand of a command; `name` is the length of the command's name.
static void search_operand(Search *search, const char *line, size_t name, size_t length) {
    static void (*const offers[])(Search *) = {
        [COMPLETE_BREAKS] = offer_breaks,   [COMPLETE_IDS] = offer_ids,
        [COMPLETE_WATCHED] = offer_watched, [COMPLETE_FILES] = offer_files,
        [COMPLETE_SYSTEMS] = offer_systems, [COMPLETE_KEYS] = offer_keys,
        [COMPLETE_KINDS] = offer_kinds,     [COMPLETE_PARAMETERS] = offer_parameters,
        [COMPLETE_MOVE] = offer_ids,        [COMPLETE_TOPICS] = offer_topics,
    };
    size_t start = name + strspn(line + name, " \t");
    begin_search(search, line, start < length ? start : length, length);
    const PromptCommand *command = prompt_find_command(line, name);
    size_t word = start + strcspn(line + start, " \t");
    if (command && command->complete == COMPLETE_PARAMETERS && word < length) {
        size_t value = word + strspn(line + word, " \t");
        begin_search(search, line, value, length);
        offer_parameter_values(search, line + start, word - start);
    } else if (command && command->complete == COMPLETE_MOVE && word < length) {
        size_t last = length;
        while (last > word && !isspace((unsigned char)line[last - 1]))
            last--;
        begin_search(search, line, last, length);
        if (memchr(line + last, '=', length - last))
            search_language(search, line, length);
        else
            offer_vectors(search);
    } else if (command && command->complete != COMPLETE_LANGUAGE)
        offers[command->complete](search);
    else
        search_language(search, line, length);
}

static int compare_words(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

// Sorts the words and removes duplicates.
static void sort_unique(TextList *words) {
    size_t kept = 1;
    qsort(words->items, words->count, sizeof *words->items, compare_words);
    for (size_t i = 1; i < words->count; i++)
        if (strcmp(words->items[i], words->items[kept - 1]) == 0)
            free(words->items[i]);
        else
            words->items[kept++] = words->items[i];
    words->count = kept;
}

// Sets completion->common to the common prefix of the words, without the typed text. Words are sorted, so only the
// first and the last are compared.
static void find_common(Completion *completion, size_t typed) {
    const char *first = completion->words.items[0], *last = completion->words.items[completion->words.count - 1];
    size_t length = 0;
    while (first[length] != '\0' && first[length] == last[length])
        length++;
    while (length > typed && ((unsigned char)first[length] & 0xc0) == 0x80)
        length--; // do not split a UTF-8 character
    text_add(&completion->common, (Str){first + typed, length - typed});
}

void complete_line(Prompt *prompt, const char *line, size_t length, Completion *completion) {
    SCOPED_STRING text = memory_strndup(line, length);
    Search search = {.prompt = prompt, .found = completion};
    *completion = (Completion){0};
    size_t name = strcspn(text, " \t");
    if (text[0] != '.') {
        search_language(&search, text, length);
    } else if (name == length) {
        begin_search(&search, text, 0, length);
        offer_commands(&search);
    } else {
        search_operand(&search, text, name, length);
    }
    if (completion->words.count > 0) {
        sort_unique(&completion->words);
        find_common(completion, search.length);
    }
}

void complete_free(Completion *completion) {
    texts_free(&completion->words);
    text_free(&completion->common);
}

void complete_show(const Completion *completion, Output *output) {
    const TextList *words = &completion->words;
    size_t max_width = 0, column = 0;
    for (size_t i = 0; i < words->count; i++)
        max_width = strlen(words->items[i]) > max_width ? strlen(words->items[i]) : max_width;
    for (size_t i = 0; i < words->count && i < MAX_SHOWN; i++) {
        if (column > 0 && column + max_width > LINE_WIDTH) {
            output_write(output, "\n", 1);
            column = 0;
        }
        output_format(output, "%-*s", (int)max_width + 2, words->items[i]);
        column += max_width + 2;
    }
    output_write(output, "\n", 1);
    if (words->count > MAX_SHOWN)
        output_format(output, "... and %zu more\n", words->count - MAX_SHOWN);
}

// plan.c: the file of --plan: the words of a command line as YAML, where they get long.
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/source.h"
#include "cli/script.h"
#include "sweep/extras.h"

#ifdef HAVE_YAML
#include <yaml.h>

typedef struct Plan {
    const char *path;
    TextList *words;
    yaml_document_t *document;
} Plan;

static const char *text_of(const yaml_node_t *node) {
    return node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

static bool complain(const Plan *plan, yaml_mark_t place, const char *what, const char *name) {
    message("%s:%zu:%zu: %s%s", plan->path, place.line + 1, place.column + 1, what, name);
    return false;
}

// A value, or the values of a list, as -D takes them.
static bool add_values(const Plan *plan, Bytes *word, const yaml_node_t *value) {
    if (text_of(value) != NULL) {
        bytes_add_text(word, text_of(value));
        return true;
    }
    if (value->type != YAML_SEQUENCE_NODE) {
        return complain(plan, value->start_mark, "this must be a value or a list of values", "");
    }
    for (yaml_node_item_t *item = value->data.sequence.items.start; item < value->data.sequence.items.top; item++) {
        const char *text = text_of(yaml_document_get_node(plan->document, *item));
        if (text == NULL) {
            return complain(plan, value->start_mark, "this list must hold values; a vector is 1;2", "");
        }
        bool vector = strchr(text, ';') != NULL && text[0] != '(';
        bytes_format(word, vector ? "%s(%s)" : "%s%s", item == value->data.sequence.items.start ? "" : ";", text);
    }
    return true;
}

// `define:` and `metric:` hold names.
static bool add_names(const Plan *plan, const char *option, const yaml_node_t *names) {
    if (names->type != YAML_MAPPING_NODE) {
        return complain(plan, names->start_mark, "below this there must be lines `NAME: VALUE`: ", option);
    }
    for (yaml_node_pair_t *pair = names->data.mapping.pairs.start; pair < names->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = yaml_document_get_node(plan->document, pair->key);
        SCOPED_BYTES word = {0};
        bytes_format(&word, "--%s=%s=", option, text_of(key) == NULL ? "" : text_of(key));
        if (!add_values(plan, &word, yaml_document_get_node(plan->document, pair->value))) {
            return false;
        }
        texts_add(plan->words, word.data);
    }
    return true;
}

// Relative to the plan's folder.
static void add_script(const Plan *plan, const char *script) {
    SCOPED_BYTES word = {0};
    bytes_format(&word, "%.*s%s", script[0] == '/' ? 0 : (int)path_directory(str_from(plan->path)).len, plan->path,
                 script);
    texts_add(plan->words, word.data);
}

static bool add_option(const Plan *plan, const OptionSpec *spec, const yaml_node_t *value) {
    const char *text = text_of(value);
    if (strcmp(spec->name, "define") == 0 || strcmp(spec->name, "metric") == 0) {
        return add_names(plan, spec->name, value);
    }
    if (text == NULL) {
        return complain(plan, value->start_mark, "this must be one value: ", spec->name);
    }
    if (spec->value == NULL && strcmp(text, "false") == 0) {
        return true;
    }
    if (spec->value == NULL && strcmp(text, "true") != 0) {
        return complain(plan, value->start_mark, "this must be true or false: ", spec->name);
    }
    SCOPED_BYTES word = {0};
    bytes_format(&word, spec->value == NULL ? "--%s" : "--%s=%s", spec->name, text);
    texts_add(plan->words, word.data);
    return true;
}

static bool add_entry(const Plan *plan, const yaml_node_t *key, const yaml_node_t *value) {
    const char *name = text_of(key) == NULL ? "" : text_of(key);
    StrNearest nearest = nearest_start(name);
    if (strcmp(name, "script") == 0 && text_of(value) != NULL) {
        add_script(plan, text_of(value));
        return true;
    }
    for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
        if (spec->commands & FOR_SWEEP && strcmp(spec->name, "plan") != 0) {
            if (strcmp(spec->name, name) == 0) {
                return add_option(plan, spec, value);
            }
            nearest_offer(&nearest, spec->name);
        }
    }
    nearest_offer(&nearest, "script");
    SCOPED_BYTES what = {0};
    bytes_format(&what, "'%s' is no option of petri sweep%s", name,
                 nearest.found.bytes == NULL ? "; 'petri help sweep' lists them" : ", did you mean ");
    return complain(plan, key->start_mark, what.data, nearest.found.bytes == NULL ? "" : nearest.found.bytes);
}

static bool add_entries(const Plan *plan) {
    const yaml_node_t *root = yaml_document_get_root_node(plan->document);
    if (root == NULL || root->type != YAML_MAPPING_NODE) {
        message("%s: a plan holds lines such as `script: dish.fl` and `frames: 100`", plan->path);
        return false;
    }
    for (yaml_node_pair_t *pair = root->data.mapping.pairs.start; pair < root->data.mapping.pairs.top; pair++) {
        if (!add_entry(plan, yaml_document_get_node(plan->document, pair->key),
                       yaml_document_get_node(plan->document, pair->value))) {
            return false;
        }
    }
    return true;
}

bool plan_read(const char *path, TextList *words) {
    SCOPED_BYTES text = {0};
    if (!bytes_read_file(&text, path)) {
        message("cannot read %s: %s", path, strerror(errno));
        return false;
    }
    yaml_parser_t parser;
    yaml_document_t document;
    if (!yaml_parser_initialize(&parser)) {
        message("out of memory");
        return false;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text.data, text.length);
    Plan plan = {path, words, &document};
    bool good = yaml_parser_load(&parser, &document) != 0;
    if (good) {
        good = add_entries(&plan);
        yaml_document_delete(&document);
    } else {
        complain(&plan, parser.problem_mark, "this is no YAML: ", parser.problem == NULL ? "" : parser.problem);
    }
    yaml_parser_delete(&parser);
    return good;
}

#else

bool plan_read(const char *path, TextList *words) {
    (void)words;
    message("cannot read %s: this petri was built without libyaml", path);
    return false;
}

#endif

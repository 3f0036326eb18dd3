// plan.c: parser for the YAML file of --plan, which contains a script and options.
#include "base/file.h"
#include "base/source.h"
#include "cli/script.h"
#include "sweep/options.h"
#include "sweep/plots.h"

#include <stdio.h>
#include <string.h>

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

static bool report_error(const Plan *plan, yaml_mark_t mark, const char *what, const char *name) {
    message("%s:%zu:%zu: %s%s", plan->path, mark.line + 1, mark.column + 1, what, name);
    return false;
}

// Appends a value, or a list of values in the syntax of -D.
static bool add_values(const Plan *plan, Text *word, const yaml_node_t *value) {
    if (text_of(value)) {
        text_add_c(word, text_of(value));
        return true;
    }
    if (value->type != YAML_SEQUENCE_NODE)
        return report_error(plan, value->start_mark, "expected a value or a list of values", "");
    for (yaml_node_item_t *item = value->data.sequence.items.start; item < value->data.sequence.items.top; item++) {
        const char *text = text_of(yaml_document_get_node(plan->document, *item));
        if (!text)
            return report_error(plan, value->start_mark, "expected a list of values; write a vector as 1;2", "");
        bool vector = strchr(text, ';') && text[0] != '(';
        text_add_format(word, vector ? "%s(%s)" : "%s%s", item == value->data.sequence.items.start ? "" : ";", text);
    }
    return true;
}

// Adds the options of `define:` or `metric:`, which contain lines `NAME: VALUE`. Without a value, `energy:` is a
// quantity.
static bool add_names(const Plan *plan, const char *option, const yaml_node_t *names) {
    if (names->type != YAML_MAPPING_NODE)
        return report_error(plan, names->start_mark, "expected indented lines `NAME: VALUE` below ", option);
    for (yaml_node_pair_t *pair = names->data.mapping.pairs.start; pair < names->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = yaml_document_get_node(plan->document, pair->key);
        const yaml_node_t *value = yaml_document_get_node(plan->document, pair->value);
        SCOPED_TEXT word = {0};
        text_add_format(&word, "--%s=%s", option, !text_of(key) ? "" : text_of(key));
        bool quantity = strcmp(option, "metric") == 0 && text_of(value) && !*text_of(value);
        text_add_c(&word, quantity ? "" : "=");
        if (!quantity && !add_values(plan, &word, value))
            return false;
        texts_add(plan->words, word.bytes);
    }
    return true;
}

// Adds the script, whose path is relative to the plan's folder.
static void add_script(const Plan *plan, const char *script) {
    SCOPED_TEXT word = {0};
    text_add_format(&word, "%.*s%s", script[0] == '/' ? 0 : (int)path_directory(str_from(plan->path)).len, plan->path,
                    script);
    texts_add(plan->words, word.bytes);
}

static bool add_option(const Plan *plan, const OptionSpec *spec, const yaml_node_t *value) {
    const char *text = text_of(value);
    if (strcmp(spec->name, "define") == 0 || strcmp(spec->name, "metric") == 0)
        return add_names(plan, spec->name, value);
    if (!text)
        return report_error(plan, value->start_mark, "expected one value for ", spec->name);
    if (!spec->value && strcmp(text, "false") == 0)
        return true;
    if (!spec->value && strcmp(text, "true") != 0)
        return report_error(plan, value->start_mark, "expected true or false for ", spec->name);
    SCOPED_TEXT word = {0};
    text_add_format(&word, !spec->value ? "--%s" : "--%s=%s", spec->name, text);
    texts_add(plan->words, word.bytes);
    return true;
}

static bool add_entry(const Plan *plan, const yaml_node_t *key, const yaml_node_t *value) {
    const char *name = !text_of(key) ? "" : text_of(key);
    StrNearest nearest = str_nearest(str_from(name));
    if (strcmp(name, "script") == 0 && text_of(value)) {
        add_script(plan, text_of(value));
        return true;
    }
    for (const OptionSpec *spec = SWEEP_OPTIONS.rows; spec->name; spec++) {
        if (strcmp(spec->name, "plan") != 0) {
            if (strcmp(spec->name, name) == 0)
                return add_option(plan, spec, value);
            nearest_offer(&nearest, spec->name);
        }
    }
    nearest_offer(&nearest, "script");
    SCOPED_TEXT what = {0};
    text_add_format(&what, "not an option of petri sweep: '%s'%s", name,
                    !nearest.found.bytes ? "; run 'petri help sweep' for a list" : "; did you mean ");
    return report_error(plan, key->start_mark, what.bytes, !nearest.found.bytes ? "" : nearest.found.bytes);
}

static bool add_entries(const Plan *plan) {
    const yaml_node_t *root = yaml_document_get_root_node(plan->document);
    if (!root || root->type != YAML_MAPPING_NODE) {
        message("%s: not a plan; write lines such as `script: dish.fl` and `frames: 100`", plan->path);
        return false;
    }
    for (yaml_node_pair_t *pair = root->data.mapping.pairs.start; pair < root->data.mapping.pairs.top; pair++)
        if (!add_entry(plan, yaml_document_get_node(plan->document, pair->key),
                       yaml_document_get_node(plan->document, pair->value)))
            return false;
    return true;
}

// Checks that brackets are not nested too deeply, because libyaml takes quadratic time for nested brackets: 17 s for
// 100 KB of them. Brackets in strings and comments are rare, so they are counted like all others. Returns false after a
// message.
static bool check_depth(const char *path, const Text *text) {
    enum { MAX_DEPTH = 64 };
    int depth = 0;
    for (size_t i = 0; i < text->len && depth <= MAX_DEPTH; i++)
        if (text->bytes[i] == '[' || text->bytes[i] == '{')
            depth++;
        else if ((text->bytes[i] == ']' || text->bytes[i] == '}') && depth > 0)
            depth--;
    if (depth > MAX_DEPTH)
        message("%s: more than %d nested brackets", path, (int)MAX_DEPTH);
    return depth <= MAX_DEPTH;
}

bool plan_read(const char *path, TextList *words) {
    SCOPED_TEXT text = {0};
    static const size_t max_bytes = 64 << 10;
    const char *problem = text_read_file(&text, path, max_bytes);
    if (problem) {
        message("cannot read %s: %s", path, problem);
        return false;
    }
    if (!check_depth(path, &text))
        return false;
    yaml_parser_t parser;
    yaml_document_t document;
    if (!yaml_parser_initialize(&parser)) {
        message("out of memory");
        return false;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text.bytes, text.len);
    Plan plan = {path, words, &document};
    bool good = yaml_parser_load(&parser, &document) != 0;
    if (good) {
        good = add_entries(&plan);
        yaml_document_delete(&document);
    } else {
        report_error(&plan, parser.problem_mark, "not valid YAML: ", !parser.problem ? "" : parser.problem);
    }
    yaml_parser_delete(&parser);
    return good;
}

#else

bool plan_read(const char *path, TextList *words) {
    (void)words;
#ifdef __EMSCRIPTEN__
    message("cannot read %s: petri for Node.js cannot read plans; write the options on the command line", path);
#else
    message("cannot read %s: petri was built without libyaml; on Debian, install libyaml-dev and build petri again",
            path);
#endif
    return false;
}

#endif

// help.c: see help.h. Apart from table.c, because libpetri-draw.so has a copy of that file.
#include "schema/help.h"

const char *const schema_kind_help[KIND_COUNT] = {
#define NODE(id, text, place, children, help) help,
#include "schema/schema_list.h"
};

#define IS(x) #x
#define DESCRIBED(x, text) text
#define INHERITED(x, text) "inherited, initially " text
#define INHERITED_TEXT(text) "inherited, initially \"" text "\""
#define NONE ""

const AttrHelp schema_help[ROW_COUNT] = {
#define ATTR(kind, name, type, field, default_value, unit, help) {default_value, unit, help},
#define ALIAS(kind, name, of, of_text, type, field, unit) {NONE, unit, "alias; " of_text " takes precedence"},
#include "schema/schema_list.h"
};

const char *schema_formula(NodeKind kind) {
    static const char *const formulas[KIND_COUNT] = {
#define NODE(id, text, place, children, help) [KIND_##id] = "",
#define FORCE(id, text, help, formula) [KIND_##id] = formula,
#include "schema/schema_list.h"
    };
    return formulas[kind];
}

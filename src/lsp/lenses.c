// lenses.c: code lenses: the commands "run", "render" and "test" above a script.
//
// The editor executes them, because they need its terminal. It lists the commands that it has in the initialization
// options; others are not shown, because nothing would happen.
#include "lsp/server.h"

#include <string.h>

// Returns true if the document has nodes, so that it is more than a module of functions.
static bool has_nodes(const Document *document) {
    for (size_t i = 0; i < document->token_count; i++)
        if (document->tokens[i].kind == PETRI_TOKEN_NODE)
            return true;
    return false;
}

void answer_lenses(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    static const char *const lenses[][2] = {{"petri.run", "run"}, {"petri.render", "render"}, {"petri.test", "test"}};
    const Document *document = request->document;
    const Server *server = request->server;
    json_open(result, NULL, "[");
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        const char *command = lenses[i][0], *title = lenses[i][1];
        bool shown = strcmp(title, "test") == 0 ? golden_tests_exist(document->path) : has_nodes(document);
        if (!shown || !document->is_file || !texts_contain(&server->commands, command))
            continue;
        json_open(result, NULL, "{");
        document_put_range(result, "range", document, 0, 0, server->utf8);
        json_open(result, "command", "{");
        json_put_text(result, "title", title);
        json_put_text(result, "command", command);
        JSON_PUT_ARRAY(result, "arguments", document->uri);
        json_close(result, "}}");
    }
    json_close(result, "]");
}

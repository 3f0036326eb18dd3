// lsp.c: `petri lsp`, a server of the Language Server Protocol 3.17.
//
// The server has one thread. It reads and answers messages, and checks changed documents when no message is waiting.
#include "cli/option_groups.h"
#include "lsp/server.h"

#include <stdlib.h>
#include <string.h>

// Options that no other command has.
typedef struct Own {
    bool stdio;
} Own;

// --- documents

// Marks the documents that import or include the touched document as unchecked.
static void mark_dependents_unchecked(Server *server, const Document *touched) {
    for (size_t i = 0; i < server->document_count; i++) {
        Document *document = server->documents[i];
        document->unchecked = document->unchecked || texts_contain(&document->used, touched->canonical);
    }
}

static void open_document(Server *server, const Json *params) {
    const Json *item = json_get(params, "textDocument");
    const char *uri = json_text(item, "uri"), *text = json_text(item, "text");
    if (!uri || !text || server_document(server, uri))
        return;
    server->documents = memory_realloc(server->documents, (server->document_count + 1) * sizeof *server->documents);
    server->documents[server->document_count++] =
        document_new(uri, str_from(text), json_integer_or(item, "version", 0));
    mark_dependents_unchecked(server, server->documents[server->document_count - 1]);
}

static void change_document(Server *server, const Json *params) {
    Document *document = server_document(server, json_text(json_get(params, "textDocument"), "uri"));
    const Json *changes = json_get(params, "contentChanges");
    if (!document || !json_is(changes, JSON_ARRAY))
        return;
    document->version = json_integer_or(json_get(params, "textDocument"), "version", document->version + 1);
    document_clear_failures(document);
    for (const Json *change = NULL; (change = json_next(changes, change));)
        document_change(document, change, server->utf8);
    mark_dependents_unchecked(server, document);
}

static void close_document(Server *server, const Json *params) {
    Document *document = server_document(server, json_text(json_get(params, "textDocument"), "uri"));
    for (size_t i = 0; document && i < server->document_count; i++) {
        if (server->documents[i] == document) {
            server->documents[i] = server->documents[--server->document_count];
            diagnostics_withdraw(server, document);
            mark_dependents_unchecked(server, document);
            document_free(document);
            break;
        }
    }
}

// Marks all documents as unchecked, because any of them may import a file that was saved or changed on disk.
static void check_all(Server *server, const Json *params) {
    (void)params;
    for (size_t i = 0; i < server->document_count; i++)
        server->documents[i]->unchecked = true;
}

static void save_document(Server *server, const Json *params) {
    Document *document = server_document(server, json_text(json_get(params, "textDocument"), "uri"));
    if (document)
        golden_tests_run(server, document);
    check_all(server, params);
}

// --- folders

// texts_add or texts_remove.
typedef void ChangeList(TextList *list, const char *text);

static void change_root(Server *server, const char *uri, ChangeList *change) {
    SCOPED_STRING path = !uri ? NULL : uri_path(uri);
    if (path) {
        SCOPED_STRING canonical = path_canonical(path);
        change(&server->roots, canonical);
    }
}

static void change_roots(Server *server, const Json *folders, ChangeList *change) {
    for (const Json *folder = NULL; (folder = json_next(folders, folder));)
        change_root(server, json_text(folder, "uri"), change);
}

static void add_roots(Server *server, const Json *params) {
    const Json *folders = json_get(params, "workspaceFolders");
    change_roots(server, folders, texts_add);
    if (!json_next(folders, NULL))
        change_root(server, json_text(params, "rootUri"), texts_add);
}

static void change_folders(Server *server, const Json *params) {
    const Json *event = json_get(params, "event");
    change_roots(server, json_get(event, "removed"), texts_remove);
    change_roots(server, json_get(event, "added"), texts_add);
}

// Asks the editor to report scripts that other programs change, because open scripts may import them.
static void watch_files(Server *server, const Json *params) {
    (void)params;
    SCOPED_TEXT text = {0};
    JsonWriter json = rpc_writer(&text);
    json_open(&json, NULL, "{");
    json_open(&json, "registrations", "[{");
    JSON_PUT_TEXTS(&json, "id", "scripts", "method", "workspace/didChangeWatchedFiles");
    json_open(&json, "registerOptions", "{");
    json_open(&json, "watchers", "[{");
    json_put_text(&json, "globPattern", "**/*.fl");
    json_close(&json, "}]}}]}");
    if (server->can_watch)
        rpc_request("client/registerCapability", &(Json){"scripts", strlen("scripts"), 1, JSON_STRING}, &text);
}

static const struct {
    const char *method;
    void (*handle)(Server *server, const Json *params);
} notifications[] = {
    {"initialized", watch_files},
    {"textDocument/didOpen", open_document},
    {"textDocument/didChange", change_document},
    {"textDocument/didClose", close_document},
    {"textDocument/didSave", save_document},
    {"workspace/didChangeWatchedFiles", check_all},
    {"workspace/didChangeWorkspaceFolders", change_folders},
};

// --- requests

static const struct {
    const char *method;
    RequestHandler *answer;
    const char *capability; // capability that is announced as true; NULL: capabilities() adds it
} requests[] = {
    {"textDocument/completion", answer_completion, NULL},
    {"textDocument/hover", answer_hover, "hoverProvider"},
    {"textDocument/signatureHelp", answer_signature, NULL},
    {"textDocument/definition", answer_definition, "definitionProvider"},
    {"textDocument/references", answer_references, "referencesProvider"},
    {"textDocument/documentHighlight", answer_highlight, "documentHighlightProvider"},
    {"textDocument/prepareRename", answer_prepare_rename, NULL},
    {"textDocument/rename", answer_rename, NULL},
    {"textDocument/documentSymbol", answer_symbols, "documentSymbolProvider"},
    {"textDocument/foldingRange", answer_folding, "foldingRangeProvider"},
    {"textDocument/selectionRange", answer_selection, "selectionRangeProvider"},
    {"textDocument/codeLens", answer_lenses, NULL},
    {"textDocument/semanticTokens/full", answer_tokens, NULL},
    {"textDocument/inlayHint", answer_hints, "inlayHintProvider"},
    {"textDocument/documentColor", answer_colours, "colorProvider"},
    {"textDocument/colorPresentation", answer_presentations, NULL},
    {"textDocument/codeAction", answer_actions, "codeActionProvider"},
    {"textDocument/formatting", answer_format, "documentFormattingProvider"},
    {"textDocument/rangeFormatting", answer_range_format, "documentRangeFormattingProvider"},
    {"textDocument/documentLink", answer_links, NULL},
    {"workspace/symbol", answer_workspace_symbols, "workspaceSymbolProvider"},
};

static void put_capabilities(JsonWriter *json, const Server *server) {
    json_open(json, "capabilities", "{");
    json_put_text(json, "positionEncoding", server->utf8 ? "utf-8" : "utf-16");
    json_open(json, "textDocumentSync", "{");
    json_put_bool(json, "openClose", true);
    json_put_integer(json, "change", 2); // incremental: the editor sends the ranges that change
    json_put_bool(json, "save", true);
    json_close(json, "}");
    for (size_t i = 0; i < sizeof requests / sizeof requests[0]; i++)
        if (requests[i].capability)
            json_put_bool(json, requests[i].capability, true);
    json_open(json, "completionProvider", "{");
    JSON_PUT_ARRAY(json, "triggerCharacters", "!", "$", ":", "'", "\"", "/");
    json_close(json, "}");
    json_open(json, "signatureHelpProvider", "{");
    JSON_PUT_ARRAY(json, "triggerCharacters", "(", ",");
    json_close(json, "}");
    json_open(json, "documentLinkProvider", "{}");
    json_open(json, "codeLensProvider", "{}");
    json_open(json, "workspace", "{");
    json_open(json, "workspaceFolders", "{");
    json_put_bool(json, "supported", true);
    json_put_bool(json, "changeNotifications", true);
    json_close(json, "}}");
    json_open(json, "renameProvider", "{");
    json_put_bool(json, "prepareProvider", true);
    json_close(json, "}");
    json_open(json, "semanticTokensProvider", "{");
    tokens_put_legend(json);
    json_put_bool(json, "full", true);
    json_close(json, "}}");
}

static void initialize(Server *server, const Json *params, JsonWriter *result) {
    const Json *encodings = json_path(params, "capabilities.general.positionEncodings");
    for (const Json *name = NULL; (name = json_next(encodings, name));)
        server->utf8 = server->utf8 || (json_is(name, JSON_STRING) && strcmp(name->text, "utf-8") == 0);
    server->can_watch =
        json_is(json_path(params, "capabilities.workspace.didChangeWatchedFiles.dynamicRegistration"), JSON_TRUE);
    add_roots(server, params);
    const Json *commands = json_path(params, "initializationOptions.commands");
    for (const Json *name = NULL; (name = json_next(commands, name));)
        if (json_is(name, JSON_STRING))
            texts_add(&server->commands, name->text);
    server->initialized = true;
    json_open(result, NULL, "{");
    put_capabilities(result, server);
    JSON_PUT_OBJECT(result, "serverInfo", "name", "petri", "version", petri_version());
    json_close(result, "}");
}

static bool answer_request(Server *server, RequestHandler *ask, const Json *id, const Json *params) {
    RequestContext request = {.server = server,
                              .document = server_document(server, json_text(json_get(params, "textDocument"), "uri")),
                              .params = params};
    bool needs_document = ask != answer_workspace_symbols;
    const char *problem = needs_document && !request.document ? "the document is not open" : NULL;
    SCOPED_TEXT result = {0};
    JsonWriter json = rpc_writer(&result);
    if (!problem && needs_document) {
        server_read(server, request.document);
        request.offset = document_offset(request.document, json_get(params, "position"), server->utf8);
    }
    if (!problem)
        ask(&request, &json, &problem);
    return problem ? rpc_send_error(id, RPC_REQUEST_FAILED, problem) : rpc_answer(id, &result);
}

static bool handle_request(Server *server, const char *method, const Json *id, const Json *params) {
    SCOPED_TEXT result = {0};
    JsonWriter json = rpc_writer(&result);
    if (strcmp(method, "initialize") == 0) {
        initialize(server, params, &json);
        return rpc_answer(id, &result);
    }
    if (!server->initialized || server->shutting_down) {
        return rpc_send_error(id, server->initialized ? RPC_INVALID_REQUEST : RPC_NOT_INITIALIZED,
                              server->initialized ? "the server is shut down" : "the server is not initialized");
    }
    if (strcmp(method, "shutdown") == 0) {
        server->shutting_down = true;
        return rpc_answer(id, &result);
    }
    for (size_t i = 0; i < sizeof requests / sizeof requests[0]; i++)
        if (strcmp(requests[i].method, method) == 0)
            return answer_request(server, requests[i].answer, id, params);
    return rpc_send_error(id, RPC_METHOD_NOT_FOUND, method);
}

static void handle_notification(Server *server, const char *method, const Json *params) {
    for (size_t i = 0; server->initialized && i < sizeof notifications / sizeof notifications[0]; i++)
        if (strcmp(notifications[i].method, method) == 0)
            notifications[i].handle(server, params);
}

// Returns false if the editor has closed the pipe.
static bool handle_message(Server *server, const Json *message) {
    const char *method = json_text(message, "method");
    const Json *id = json_get(message, "id");
    if (!method) {
        return json_get(message, "result") || json_get(message, "error") || !id
                   ? true // ignores the response to watch_files
                   : rpc_send_error(id, RPC_INVALID_REQUEST, "the message has no method");
    }
    if (id)
        return handle_request(server, method, id, json_get(message, "params"));
    handle_notification(server, method, json_get(message, "params"));
    return true;
}

static void check_changed_documents(Server *server) {
    // The second pass makes full checks of documents that exceeded the small work limit in the first pass.
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < server->document_count && !rpc_has_input(&server->input); i++)
            if (server->documents[i]->unchecked)
                diagnostics_publish(server, server->documents[i]);
}

static int lsp_run(const CommandContext *host, Options *options) {
    Server server = {.host = host, .options = options, .collect = diagnostics_collect};
    int status = STATUS_FAILED;
    server_init_access(&server);
    bool reading = server_open_session(&server);
    while (reading) {
        SCOPED_JSON document = {0};
        const Json *message;
        RpcRead came = rpc_read(&server.input, &document, &message);
        const char *method = json_text(message, "method");
        if (came == RPC_END || (method && strcmp(method, "exit") == 0)) {
            status = server.shutting_down ? STATUS_DONE : STATUS_FAILED;
            reading = false;
        } else if (came == RPC_INVALID) {
            reading = rpc_send_error(NULL, RPC_PARSE_ERROR, "not valid JSON");
        } else {
            reading = handle_message(&server, message);
        }
        if (reading)
            check_changed_documents(&server);
    }
    for (size_t i = 0; i < server.document_count; i++)
        document_free(server.documents[i]);
    free(server.documents);
    texts_free(&server.roots);
    texts_free(&server.commands);
    arena_free(&server.arena);
    text_free(&server.input);
    petri_close(&server.session);
    petri_close(&server.quick);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("stdio", 0, NULL, option_flag, stdio, "use standard input and output (default; there is no other transport)")
    DEFINE_NAME_OPTION FILE_OPTIONS LIMIT_OPTIONS NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable LSP_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command LSP_COMMAND = {
    .name = "lsp",
    .operands = "",
    .summary = "start the language server (LSP) for editors",
    .details =
        "Implements the Language Server Protocol on standard input and output; editors start it. Reports the errors\n"
        "and warnings of petri check as you type, completes names, nodes, attributes and keys, shows help and values\n"
        "of constants, goes to definitions, renames, formats, and offers quick fixes. Evaluates the first frame, as\n"
        "petri check does, without drawing, printing or storing anything.",
    .examples = "  vim.lsp.start({ name = 'petri', cmd = { 'petri', 'lsp' } })    -- for Neovim\n",
    .options = &LSP_OPTIONS,
    .second_operand_error = "too many arguments: '%s'; the editor opens the scripts",
    .run = lsp_run,
};

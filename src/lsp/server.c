// server.c: the open documents of the language server, other files, and the sessions that read them; see server.h.
//
// There are two sessions: one for complete checks, which a new message interrupts, and a quick one, which has a small
// limit of work and is not interrupted.
#include "lsp/server.h"

#include "base/file.h"
#include "base/source.h"

#include <fcntl.h>
#include <string.h>

enum { MAX_READ = 4 << 20 };

Document *server_document(const Server *server, const char *uri) {
    for (size_t i = 0; uri && i < server->document_count; i++)
        if (strcmp(server->documents[i]->uri, uri) == 0)
            return server->documents[i];
    return NULL;
}

static Document *find_open_document(const Server *server, const char *canonical) {
    for (size_t i = 0; i < server->document_count; i++)
        if (strcmp(server->documents[i]->canonical, canonical) == 0)
            return server->documents[i];
    return NULL;
}

void server_init_access(Server *server) {
    arena_init(&server->arena, "file access", SIZE_MAX);
    server->access.no_files = server->options->no_files;
    file_access_add(&server->arena, &server->access, FILE_ACCESS_READ, (const char *const[]){".", NULL});
    file_access_add(&server->arena, &server->access, FILE_ACCESS_READ,
                    (const char *const *)server->options->read_folders.items);
}

Document *server_file(Server *server, const char *path, const Document *main, bool *read) {
    SCOPED_STRING canonical = path_canonical(path);
    Document *document = find_open_document(server, canonical);
    *read = false;
    if (document)
        return document;
    SCOPED_TEXT text = {0};
    Str folder = path_directory(str_from(main->canonical));
    SCOPED_STRING own = memory_strndup(folder.bytes, folder.len > 1 ? folder.len - 1 : folder.len);
    FileAccess access = server->access;
    access.script_folder = main->is_file ? str_from(own) : (Str){0};
    *read =
        !text_read_regular(&text, file_access_open(&access, canonical, O_RDONLY | O_NONBLOCK), SERVER_MAX_FILE_BYTES);
    if (!*read)
        return NULL;
    SCOPED_STRING uri = uri_of(canonical);
    return document_new(uri, text_str(&text), -1);
}

const char *server_unsaved(void *host, const char *path, size_t *length) {
    Server *server = host;
    if (server->checking && !texts_contain(&server->checked->used, path))
        texts_add(&server->checked->used, path);
    const Document *document = find_open_document(server, path);
    *length = !document ? 0 : document->text.len;
    return !document ? NULL : document->text.bytes;
}

// Interrupts a full check when a message arrives, because a check of a heavy script takes many seconds.
static bool should_interrupt(void *user_data) {
    const Server *server = user_data;
    return server->checking && rpc_has_input(&server->input);
}

bool server_open_session(Server *server) {
    static const uint64_t quick_work = 1 << 24; // about 0.2 s
    petri_close(&server->session);
    petri_close(&server->quick);
    Options options = *server->options;
    options.threads = 1;
    options.unsaved = server_unsaved;
    options.unsaved_host = server;
    options.should_interrupt = should_interrupt;
    server->read = 0;
    if (options_open(&options, server->host, server->collect, server, &server->session) != OPTIONS_READ)
        return false;
    options.work = options.work > 0 && options.work < quick_work ? options.work : quick_work;
    options.should_interrupt = NULL;
    return options_open(&options, server->host, server->collect, server, &server->quick) == OPTIONS_READ;
}

// Updates tokens and names of a document. Opens a new session after every 4 MiB of text, because a session never frees
// symbols.
void server_read(Server *server, Document *document) {
    server->read += document->unread ? document->text.len : 0;
    if (server->read > MAX_READ)
        server_open_session(server);
    if (server->session)
        document_read(document, server->session);
}

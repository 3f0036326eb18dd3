// dump.c: output of the syntax tree and the compiled code (petri_dump).
#include "session/session.h"
#include "session/text_sink.h"
#include "syntax/parse.h"

static void dump_code(TextSink *out, PetriSession *session, unsigned what) {
    const Unit *unit = session->config.program;
    if (what == PETRI_DUMP_CODE) {
        program_print(&out->text, &session->symbols, unit->program);
    } else { // parses the text again, because the syntax tree was freed after compilation
        DiagSink discarded = diag_sink_new(out->text.arena, 0);
        const Ast *ast = parse_program(out->text.arena, &session->symbols, unit->source, &discarded);
        ast_print(&out->text, &session->symbols, unit->source, ast);
        diag_sink_free(&discarded);
    }
}

PetriStatus petri_dump(PetriSession *session, PetriDump what, PetriWriteCallback *write, void *host) {
    if (!session || !write || !session->config.program)
        return PETRI_INVALID;
    return text_sink_run(session, dump_code, what, write, host);
}

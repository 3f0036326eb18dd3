// command_list.h: the commands in the order of help.
//
// COMMAND(name, constant, programs): a command, whose constant is NAME_COMMAND, and the programs that can execute it.
// HIDDEN(name, constant, programs): the same, for a command that help, completion and manual do not list. These rows
// are last. src/packaging/meson.build also reads the rows.
COMMAND("run", RUN, PETRI | PICTURES | RANKS | NEEDS_RANKS)
COMMAND("view", VIEW, PICTURES)
COMMAND("render", RENDER, PICTURES)
COMMAND("repl", REPL, PICTURES)
COMMAND("sweep", SWEEP, PETRI | PICTURES | RANKS)
COMMAND("test", TEST, PETRI | PICTURES)
COMMAND("diff", DIFF, PETRI | PICTURES)
COMMAND("check", CHECK, PETRI | PICTURES)
COMMAND("fmt", FMT, PETRI | PICTURES)
COMMAND("lsp", LSP, PETRI | PICTURES)
COMMAND("send", SEND, PETRI | PICTURES)
COMMAND("link", LINK, PICTURES)
COMMAND("open", OPEN, PICTURES)
COMMAND("verify", VERIFY, PICTURES | RANKS)
COMMAND("info", INFO, PICTURES)
COMMAND("cite", CITE, PICTURES)
COMMAND("unpack", UNPACK, PICTURES)
COMMAND("new", NEW, PETRI | PICTURES)
COMMAND("help", HELP, PICTURES)
HIDDEN("--help", HELP, PICTURES)
HIDDEN("-h", HELP, PICTURES)
HIDDEN("complete", COMPLETE, PICTURES)
HIDDEN("--test-shader", SHADER_TEST, PICTURES)

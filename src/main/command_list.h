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
COMMAND("trust", TRUST, PETRI | PICTURES)
COMMAND("test", TEST, PETRI | PICTURES)
COMMAND("diff", DIFF, PETRI | PICTURES)
COMMAND("check", CHECK, PETRI | PICTURES)
COMMAND("fmt", FMT, PETRI | PICTURES)
COMMAND("lsp", LSP, PETRI | PICTURES)
COMMAND("link", LINK, PICTURES)
COMMAND("archive", ARCHIVE, PICTURES | RANKS)
COMMAND("new", NEW, PETRI | PICTURES)
COMMAND("help", HELP, PICTURES)
// Forms of a command that main recognises by an operand or an option.
HIDDEN("run LINK", RUN_LINK, PICTURES)
HIDDEN("render LINK", RUN_LINK, PICTURES)
HIDDEN("view LINK", VIEW_LINK, PICTURES)
HIDDEN("view --send", SEND, PETRI | PICTURES)
HIDDEN("test --new", TEST_NEW, PETRI | PICTURES)
// Names of petri 0.2, which still work in this version.
HIDDEN("open", RUN_LINK, PICTURES)
HIDDEN("send", OLD_SEND, PETRI | PICTURES)
HIDDEN("verify", VERIFY, PICTURES | RANKS)
HIDDEN("info", INFO, PICTURES)
HIDDEN("cite", CITE, PICTURES)
HIDDEN("unpack", UNPACK, PICTURES)
// Words that only programs and scripts use, except for the first two.
HIDDEN("--help", HELP, PICTURES)
HIDDEN("-h", HELP, PICTURES)
HIDDEN("complete", COMPLETE, PICTURES)
HIDDEN("--test-shader", SHADER_TEST, PICTURES)
HIDDEN("--compare-pictures", COMPARE_PICTURES, PICTURES)
HIDDEN("--check-properties", CHECK_PROPERTIES, PETRI | PICTURES)

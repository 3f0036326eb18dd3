"""The Pygments lexer and petri's scanner classify the tokens of the samples in the same way."""

import sys
from pathlib import Path

try:
    import pygments.lexers  # noqa: F401
except ImportError:
    print("skipped: there is no pygments (Debian: python3-pygments)")
    sys.exit(0)

from petri._petri import ffi, lib
from petri.lexer import FlitterLexer
from pygments.token import Comment, Error, Keyword, Name, Number, Operator, Punctuation, String

CLASSES = [(Operator.Word, lib.PETRI_TOKEN_KEYWORD), (Operator, lib.PETRI_TOKEN_OPERATOR),
           (Punctuation, lib.PETRI_TOKEN_OPERATOR), (Keyword, lib.PETRI_TOKEN_KEYWORD), (Number, lib.PETRI_TOKEN_NUMBER),
           (String.Symbol, lib.PETRI_TOKEN_SYMBOL), (String, lib.PETRI_TOKEN_STRING), (Comment, lib.PETRI_TOKEN_COMMENT),
           (Name.Class, lib.PETRI_TOKEN_NODE), (Name.Entity, lib.PETRI_TOKEN_NODE), (Name.Decorator, lib.PETRI_TOKEN_TAG),
           (Name, lib.PETRI_TOKEN_NAME), (Error, lib.PETRI_TOKEN_INVALID)]
options = ffi.new("PetriOptions *")
lib.petri_options_init(options, ffi.sizeof("PetriOptions"))
session = lib.petri_open(options)


def by_petri(text):
    tokens, data = [], text.encode()

    @ffi.callback("void(void *, const PetriToken *)")
    def take(_, token):
        if token.end > token.start:
            tokens.append((data[token.start:token.end].decode(), token.kind))
    assert lib.petri_tokenise(session, data, len(data), take, ffi.NULL) == lib.PETRI_OK
    return tokens


def by_lexer(text):
    return [(part.rstrip("\n"), next(number for kind, number in CLASSES if found in kind))
            for found, part in FlitterLexer(ensurenl=False, stripnl=False).get_tokens(text) if part.strip(" \t\n\\")]


count = 0
for path in sorted(Path(sys.argv[1]).rglob("*.fl")):
    wanted, found = by_petri(path.read_text()), by_lexer(path.read_text())
    assert found == wanted, (path, next((a, b) for a, b in zip(found + [None], wanted + [None]) if a != b))
    count += len(wanted)
assert count > 3000, count
assert [str(kind) for kind, part in FlitterLexer().get_tokens("sin !particle x") if part.strip()] == [
    "Token.Name.Builtin", "Token.Name.Class", "Token.Name"]
print(f"{count} tokens have the classes of petri's scanner")

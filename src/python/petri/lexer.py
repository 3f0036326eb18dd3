"""A Pygments lexer for Flitter, named `flitter`: for documents, notebooks and terminals."""

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Error, Keyword, Name, Number, Operator, Punctuation, String, Whitespace

from ._petri import ffi, lib

__all__ = ["FlitterLexer"]

_NAME = r"[^\W\d]\w*'*"
_END = r"(?![\w'])"


def _names(make, kind):
    """Yields the names in one of petri's tables."""
    row, number = ffi.new(kind + " *"), 0
    while make(number, row, ffi.sizeof(kind)):
        yield ffi.string(row.name).decode()
        number += 1


_BUILTINS = frozenset(_names(lib.petri_builtin, "PetriBuiltin"))
_NODES = frozenset(_names(lib.petri_node_kind, "PetriNodeKind"))


def _name(lexer, match):
    yield match.start(), Name.Builtin if match.group() in _BUILTINS else Name, match.group()


def _node(lexer, match):
    yield match.start(), Name.Class if match.group()[1:] in _NODES else Name.Entity, match.group()


class FlitterLexer(RegexLexer):
    name = "Flitter"
    aliases = ["flitter"]
    filenames = ["*.fl"]
    mimetypes = ["text/x-flitter"]
    url = "https://flitter.readthedocs.io"

    tokens = {
        "root": [
            (r"\A[ \t]*#!.*\n", Comment.Hashbang),
            (r"\s+|\\\n", Whitespace),
            (r"--.*", Comment.Single),
            (r"'''(?:'{0,2}(?:[^'\\]|\\.))*'''|\"\"\"(?:\"{0,2}(?:[^\"\\]|\\.))*\"\"\"", String),
            (r"'(?:[^'\\\n]|\\.)*'|\"(?:[^\"\\\n]|\\.)*\"", String),
            (r"(?:\d+:)?[0-5]?\d:[0-5]?\d(?:\.\d+)?", Number),
            (r"(?:\d[_\d]*(?:\.\d[_\d]*)?|\.\d[_\d]*)(?:[eE][-+]?\d[_\d]*)?(?:deg|[pnuµmkMGT°])?", Number),
            (rf"import{_END}(?=[ \t]+{_NAME}(?:[ \t]*;[ \t]*{_NAME})*[ \t]*from)", Keyword, "import"),
            (r"(let)([ \t]+)(stable)(?=[ \t]+[^\W\d])", bygroups(Keyword, Whitespace, Keyword)),
            (rf"(let){_END}(?=[ \t]+[^\W\d])(?!\s*[=(])", Keyword),
            (rf"func{_END}(?=(?:\s+{_NAME})?\s*\()", Keyword),
            (r"%(?:pragma|include)", Keyword),
            (rf"(?:for|in|if|elif|else|where){_END}(?!\s*=(?!=))", Keyword),
            (rf"(?:and|or|xor|not){_END}(?!\s*=(?!=))", Operator.Word),
            ("!" + _NAME, _node),
            (":" + _NAME, String.Symbol),
            ("#" + _NAME, Name.Decorator),
            (rf"{_NAME}(?=\s*=(?!=))", Name.Attribute),
            (_NAME, _name),
            (r"<<|==|!=|<=|>=|\.\.|//|\*\*|[@$=<>+%/*|-]", Operator),
            (r"[,\[\];()]", Punctuation),
            (r".", Error),
        ],
        "import": [
            (r"[ \t]+", Whitespace),
            (r"from", Keyword, "#pop"),
            (_NAME, Name),
            (r";", Punctuation),
        ],
    }

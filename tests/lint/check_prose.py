#!/usr/bin/env python3
"""check_prose.py SOURCE_ROOT [FILE...]: comments, messages and documents contain no phrase of prose.txt.

Reads comments, string literals of two or more words, and Markdown outside code. A phrase may be broken over two lines.
prose_exceptions.txt lists what may stay, with a reason. retired.txt lists names that must not come back.
"""
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
KINDS = {'.c': 'c', '.h': 'c', '.re': 'c', '.y': 'c', '.cpp': 'c', '.mjs': 'js', '.js': 'js', '.ts': 'js', '.glsl': 'c',
         '.frag': 'c', '.vert': 'c', '.md': 'md', '.sh': 'sh', '.py': 'sh', '.yml': 'sh', '.build': 'sh', '.cmake': 'sh'}
SHELL_FILES = {'dev', 'run', 'builds', 'fresh', 'clean-install', 'web', 'clean-env'}
# The rules of prose.txt for names in code, by the ending of a file.
NAME_RULES = {'.c': 'name', '.h': 'name', '.mjs': 'script name', '.js': 'script name', '.ts': 'script name', '.py': 'script name'}
# Recorded output, text by other authors, and the files of this lint.
SKIPPED = re.compile(r'^(CHANGELOG\.md|LICENSE|tests/conformance/|tests/golden/.*\.fl|tests/fuzz/(crashes|corpus)/|'
                     r'tests/lint/(prose|retired)|src/manual/migrating\.md)|_tables\.h$')


class Rule:
    """A line of prose.txt: where it applies, the pattern, and what to write instead, separated by tabs. "WHERE except A B"
    leaves out the folders A and B."""

    def __init__(self, line):
        where, pattern, self.instead = line.split('\t')
        self.where, _, folders = where.partition(' except ')
        self.excluded = tuple(folder + '/' for folder in folders.split())
        ignore_case = not re.search('[A-Z]', re.sub(r'\\[A-Z]|\[A-Z\]', '', pattern))
        self.anchored = pattern.startswith('^')
        self.regex = re.compile(pattern, re.I if ignore_case else 0)


def read_rows(name):
    """Returns the lines of a table without comments and empty lines."""
    text = (HERE / name).read_text(encoding='utf8')
    return [line for line in text.splitlines() if line.strip() and not line.startswith('#')]


def tracked_files(root):
    """Returns the files that git tracks, or all files where the tree is not a checkout."""
    listed = subprocess.run(['git', '-C', root, 'ls-files', '-co', '--exclude-standard'], capture_output=True, text=True,
                            check=False)
    if listed.returncode == 0:
        return listed.stdout.splitlines()
    folders = ('lib', 'src', 'grammar', 'tests', 'samples', '.ci')
    found = [p for folder in folders for p in Path(root, folder).rglob('*') if p.is_file() and 'node_modules' not in p.parts]
    return [str(p.relative_to(root)) for p in found + list(Path(root).glob('*')) if p.is_file()]


def kind_of(path):
    """Returns 'c', 'js', 'md' or 'sh'; None for files without prose."""
    name = Path(path)
    if name.name in SHELL_FILES and (str(name.parent) in ('.', '.ci')):
        return 'sh'
    return KINDS.get(name.suffix)


def blocks_of_markdown(lines):
    """Yields blocks of (number, text) outside fenced and indented code; inline code is removed."""
    block, fenced = [], False
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith('```'):
            fenced = not fenced
            line = ''
        if fenced or line.startswith('    ') or not line.strip():
            if block:
                yield 'prose', block
            block = []
            continue
        block.append((number, re.sub(r'`[^`]*`', '`', line)))
    if block:
        yield 'prose', block


STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')
JS_STRING = re.compile(r'''(?:"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)'|`((?:[^`\\]|\\.)*)`)''')


def split_comment(line, mark):
    """Splits a line of code at its comment; marks within strings do not count. Returns code and comment or None."""
    quote = None
    i = 0
    while i < len(line):
        char = line[i]
        if quote:
            if char == '\\':
                i += 1
            elif char == quote:
                quote = None
        elif char in '"\'' and not (char == "'" and mark == '#' and i and line[i - 1].isalnum()):
            quote = char
        elif line.startswith(mark, i) and (mark != '#' or i == 0 or line[i - 1].isspace()):
            return line[:i], line[i + len(mark):]
        i += 1
    return line, None


def blocks_of_code(lines, kind):
    """Yields ('comment', block) for consecutive comment lines, and ('string', block) for each longer literal."""
    mark = '#' if kind == 'sh' else '//'
    block, last_column = [], None
    starred = False
    for number, line in enumerate(lines, 1):
        comment = None
        if starred:
            comment, starred = line.strip().lstrip('*').split('*/')[0], '*/' not in line
            code = ''
        elif kind != 'sh' and line.lstrip().startswith('/*'):
            comment = line.lstrip()[2:].lstrip('*').split('*/')[0]
            starred = '*/' not in line
            code = ''
        else:
            code, comment = split_comment(line, mark)
            if comment is not None and kind == 'sh' and comment.startswith('!'):
                comment = None
        for found in (JS_STRING if kind == 'js' else STRING).finditer(code) if kind != 'sh' else ():
            text = next(group for group in found.groups() if group is not None)
            if re.search(r'\w+ +\w', text):
                yield 'string', [(number, text)]
        own_line = comment is not None and not code.strip()
        if block and (comment is None or (own_line and last_column is False) or not comment.strip()):
            yield 'comment', block
            block = []
        if comment is not None and comment.strip():
            if block and not own_line:
                yield 'comment', block
                block = []
            block.append((number, comment[1:] if comment.startswith(' ') else comment))
        last_column = own_line
    if block:
        yield 'comment', block


def code_only(lines, kind):
    """Returns the lines without comments and the texts of strings, so that only names and punctuation are left."""
    mark = '#' if kind == 'sh' else '//'
    pattern = JS_STRING if kind == 'js' else STRING
    return [re.sub(r"'(?:[^'\\]|\\.)*'", "''", pattern.sub('""', split_comment(line, mark)[0])) for line in lines]


def find_hits(rules, kind, what, block):
    """Yields (line number, text, rule) for a block."""
    joined, starts = '', []
    for number, text in block:
        starts.append((len(joined), number))
        joined += text.strip() + ' '

    def line_at(offset):
        return max(pair for pair in starts if pair[0] <= offset)[1]

    for rule in rules:
        if rule.where.endswith('name') or (rule.where == 'comment' and what != 'comment') or (rule.where == 'string' and what != 'string'):
            continue
        if rule.anchored:
            for number, text in block:
                if rule.regex.search(text):
                    yield number, text, rule
        else:
            text = joined if what != 'string' else '"' + joined.strip() + '"'
            for found in rule.regex.finditer(text):
                yield line_at(found.start()), text[max(0, found.start() - 30):found.end() + 30], rule


def main():
    root = sys.argv[1]
    only = sys.argv[2:]
    rules = [Rule(line) for line in read_rows('prose.txt')]
    exceptions = [line.split('\t') for line in read_rows('prose_exceptions.txt')]
    retired = set(read_rows('retired.txt'))
    used, faults = set(), 0
    for path in only or tracked_files(root):
        kind = kind_of(path)
        if SKIPPED.search(path) or not Path(root, path).is_file():
            continue
        try:
            text = Path(root, path).read_text(encoding='utf8')
        except UnicodeDecodeError:
            continue
        lines = text.splitlines()
        hits = []
        for number, line in enumerate(lines, 1):
            for word in set(re.findall(r'\w+', line)) & retired:
                hits.append((number, line, 'retired name: ' + word))
        if kind:
            blocks = blocks_of_markdown(lines) if kind == 'md' else blocks_of_code(lines, kind)
            for what, block in blocks:
                hits += [(n, t, 'write: ' + r.instead) for n, t, r in find_hits(rules, kind, what, block)]
        where = NAME_RULES.get(Path(path).suffix)
        for rule in rules:
            if where and rule.where == where and not path.startswith(rule.excluded):
                hits += [(n, lines[n - 1], rule.instead) for n, code in enumerate(code_only(lines, kind), 1)
                         if rule.regex.search(code)]
        for number, line, reason in hits:
            allowed = [i for i, row in enumerate(exceptions) if row[0] == path and row[1] in line]
            used.update(allowed)
            if not allowed:
                print('%s:%d: %s   [%s]' % (path, number, line.strip()[:100], reason))
                faults += 1
    if not only:
        for i, row in enumerate(exceptions):
            if i not in used:
                print('prose_exceptions.txt: not needed any more: %s: %s' % (row[0], row[1]))
                faults += 1
    if faults:
        print('%d phrases; see CONTRIBUTING.md, "Language"' % faults)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())

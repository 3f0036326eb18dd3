#!/usr/bin/env python3
"""single.py: makes petri.c, the language and the particle engine as one C file.

usage: single.py BUILD FOLDER

Writes petri.c and its headers into FOLDER, from the sources and from the generated files of the folder BUILD. The text
of each source is copied; no name is changed. Internal headers replace their first `#include`, and declarations become
static. Names of different files must therefore differ: the compiler checks this, and this script the macros of headers.

The vector kernels are compiled several times. Their text is at the end of the file, which includes itself once per
instruction set; there, macros add the name of the set to all names of the kernels.
"""
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = ['base', 'maths', 'physics', 'ranks', 'value', 'schema', 'state', 'builtin', 'ast', 'grammar', 'syntax',
             'program', 'vm', 'scene', 'canvas', 'session', 'edit', 'accuracy']
PUBLIC = ['petri.h', 'petri-edit.h', 'petri-inspect.h', 'petri-live.h']
INCLUDE = re.compile(r'^\s*#\s*include "([^"]+)"')
DEFINE = re.compile(r'^\s*#\s*define (\w+)')
UNDEF = re.compile(r'^\s*#\s*undef (\w+)')
# Declarations of functions, also as lines of macros, and of objects; definitions of objects.
PROTOTYPE = re.compile(r'(|    |#define \w+\(.*\) )'
                       r'(?!static|typedef|extern|return|else|KERNEL|PETRI_API|_Static_assert|__|.*heap_exhausted)'
                       r'(?:[A-Za-z_][\w *]*[ *][\w#]+ ?\((?!.*\{)|\w+ \w+##\w+;)')
FUNCTIONS = re.compile(r'()[A-Z]\w+ \w+(, \w+)*;') # of a type
EXTERN = re.compile(r'extern (?!"C")')
EXTERN_NAME = re.compile(r'(\w+)(?:\[[^]]*\])*(?: PRIVATE_API.*)?[,;]')
OBJECT = re.compile(r'(?!static|extern|typedef|return|__)[A-Za-z_][\w *]*[ *](\w+)(?:(?:\[.*\])* = |;$)')
# Replaced by the stub without ranks, by the passes over the kernels, or by the choice of the system's file.
OMITTED = re.compile(r'ranks/(?!ranks\.h)|maths/copied\.c|base/os_|base/sha256_isa\.c')

FOREIGN = ['xxhash.h', 'parser.c', 'lexer.c']
PARTS = ROOT / 'src/packaging/single'
# Kernels that are also compiled with one lane.
ONE_LANE = ['maths_isa.c', 'arrays_isa.c', 'kernel_integrate.c']
# The passes over the kernels: the instructions of x86-64 that they need, if any, and the macros that they set.
WIDE = 'avx512f,avx512dq,avx512vl,avx512bw,fma'
PASSES = {
    'two': ('', {'LANES': 2, 'FUSED': 0, 'MATHS_ISA': 'pair', 'HAS_FMA': 'PETRI_HAS_FMA'}),
    'fma': ('avx2,fma', {'LANES': 1, 'FUSED': 0, 'MATHS_ISA': 'fma', 'HAS_FMA': 1}),
    'avx2': ('avx2,fma', {'LANES': 4, 'FUSED': 0, 'MATHS_ISA': 'avx2', 'HAS_FMA': 1}),
    'avx2_fused': ('avx2,fma', {'LANES': 4, 'FUSED': 1, 'MATHS_ISA': 'avx2', 'HAS_FMA': 1}),
    'avx512': (WIDE, {'LANES': 8, 'FUSED': 0, 'MATHS_ISA': 'avx512', 'HAS_FMA': 1}),
    'avx512_fused': (WIDE, {'LANES': 8, 'FUSED': 1, 'MATHS_ISA': 'avx512', 'HAS_FMA': 1}),
}
PARAMETERS = {'LANES', 'FUSED', 'MATHS_ISA', 'HAS_FMA'}
SYSTEMS = [('#if defined(__linux__)', 'base/os_linux.c'), ('#elif defined(__APPLE__)', 'base/os_macos.c'),
           ('#else', 'base/os_posix.c'), ('#endif\n#if !defined(__linux__)', 'base/os_not_linux.c')]


def fail(message):
    sys.exit('single.py: ' + message)


class Sources:
    """The texts of all source files by path."""

    def __init__(self, build):
        self.folders = [ROOT / 'lib', ROOT / 'lib/include', build / 'lib', build / 'grammar', build / 'lib/state']
        self.texts = {}

    def find(self, name, beside=None):
        for folder in ([beside] if beside else []) + self.folders:
            if (folder / name).is_file():
                return (folder / name).resolve()
        fail(f'no file {name}')

    def lines(self, path):
        if path not in self.texts:
            self.texts[path] = path.read_text(encoding='utf-8').splitlines()
        return self.texts[path]

    def included(self, path, line):
        """Returns the path of the internal header that a line includes, or None."""
        match = INCLUDE.match(line)
        if line == '#include <xxhash.h>':
            return self.folders[-1] / 'xxhash.h'
        if not match or match[1] in PUBLIC:
            return None
        return self.find(match[1], path.parent)

    def headers(self, path):
        """Returns the internal headers that a file includes."""
        return [header for header in (self.included(path, line) for line in self.lines(path)) if header]

    def closure(self, path):
        """Returns the internal headers that a file needs; a header comes after those that it includes."""
        found = []
        for header in self.headers(path):
            found += [each for each in self.closure(header) + [header] if each not in found]
        return found

    def macros(self, path):
        """Returns the macros that a file defines and does not undefine."""
        defined, before = set(), ''
        for line in self.lines(path):
            if match := DEFINE.match(line):
                if before != '#ifndef ' + match[1]: # otherwise it may be a macro of the system
                    defined.add(match[1])
            elif match := UNDEF.match(line):
                defined.discard(match[1])
            elif (header := self.included(path, line)) and is_repeated(self.lines(header)):
                defined -= {m[1] for m in map(UNDEF.match, self.lines(header)) if m}
            before = line
        return sorted(defined - PARAMETERS)



def is_repeated(lines):
    """Returns whether a header is a list that files include several times."""
    text = '\n'.join(lines)
    return '#pragma once' not in lines and not re.search(r'^# *ifndef (\w+_H\w*)\n# *define \1\b', text, re.MULTILINE)


class Writer:
    def __init__(self, sources, objects):
        self.sources = sources
        self.objects = objects # names of the objects that are defined without macros
        self.out = []
        self.seen = set()

    def add(self, path, skipped=()):
        """Adds a file with the headers that it includes, except those that have been added."""
        lines = self.sources.lines(path)
        if path.suffix == '.c' or not is_repeated(lines):
            if path in self.seen:
                return
            self.seen.add(path)
        self.title(path)
        before = ''
        for line in lines:
            header = self.sources.included(path, line)
            if header:
                before = len(self.out)
                if header not in skipped:
                    self.add(header, skipped)
                if len(self.out) > before:
                    self.title(path, ', continued')
            elif not line.startswith(('#pragma once', '#line')):
                self.out.append(self.private(path, line, before.endswith('\\')))
            before = line
        if path.suffix == '.c':
            self.out += ['#undef ' + name for name in self.sources.macros(path)]

    def private(self, path, line, in_macro):
        """Makes a declaration `static`, so that it cannot collide with a name of the host."""
        if path.name in FOREIGN:
            return line
        if path.suffix == '.c':
            match = OBJECT.match(line)
            return 'static ' + line if match and match[1] in self.objects else line
        if EXTERN.match(line):
            names = set(EXTERN_NAME.findall(line))
            return 'static ' + line[len('extern '):] if names and names <= self.objects else line
        match = FUNCTIONS.match(line) or PROTOTYPE.match(line)
        if not match or (match[1] == '    ' and not in_macro):
            return line
        return match[1] + 'static ' + line[len(match[1]):]

    def title(self, path, what=''):
        self.out.append(f'/************** {self.name(path)}{what} **************/')

    def name(self, path):
        for root in [ROOT, self.sources.folders[2].parent]:
            if path.is_relative_to(root):
                return str(path.relative_to(root))
        return path.name


def library_sources(build):
    """Returns the C files of the libraries in meson's order."""
    out = subprocess.run(['meson', 'introspect', build, '--targets'], check=True, stdout=subprocess.PIPE)
    found = {name: [] for name in LIBRARIES}
    for target in json.loads(out.stdout):
        folder = Path(target['defined_in']).parent
        if target['type'] != 'static library' or folder.parent.name == 'unit' or folder.name not in found:
            continue
        for group in target['target_sources']:
            for path in map(Path, group.get('sources', []) + group.get('generated_sources', [])):
                if path.suffix == '.c' and path not in found[folder.name]:
                    found[folder.name].append(path)
    return [path for name in LIBRARIES for path in found[name] if not OMITTED.search(str(path))]


def depends_on_lanes(path, sources):
    """Returns whether a file contains code for LANES particles, by itself or by a header that it includes."""
    return path.name == 'lanes.h' or any(depends_on_lanes(header, sources) for header in sources.headers(path))


def kernel_text(kernels, writer):
    """Returns the text of the kernels, which is compiled in several passes, and its macros.

    Passes with LANES = 1 have the scalar functions, those with FUSED = 1 the kernels with fused roots.
    """
    sources, seen = writer.sources, writer.seen
    writer = Writer(sources, writer.objects)
    writer.seen = {path for path in seen if not depends_on_lanes(path, sources)}
    scalar = [path for path in kernels if path.name == 'maths_isa.c']
    wide = set().union(*(sources.closure(path) for path in kernels if path not in scalar))
    for header in sources.closure(scalar[0]):
        if header in wide:
            writer.add(header)
    fused = [path for path in kernels if path.name in ['kernel_pair_2d.c', 'kernel_pair_3d.c']]
    for condition, files in [('#if LANES == 1', scalar), ('#else', fused), ('#if !FUSED', kernels)]:
        writer.out.append(condition)
        for path in files:
            if path not in writer.seen:
                writer.add(path)
    writer.out += ['#endif'] * 2
    macros = {name for path in writer.seen - seen for name in sources.macros(path)}
    macros |= {name for path in seen if depends_on_lanes(path, sources) for name in sources.macros(path)}
    return writer.out, sorted(macros)


def preprocessed(lines, options):
    """Returns the tokens of a text without system headers."""
    text = '\n'.join(line for line in lines if not line.lstrip().startswith('#include'))
    command = ['cc', '-E', '-P', '-x', 'c', *options, '-']
    out = subprocess.run(command, input=text, check=True, stdout=subprocess.PIPE, text=True)
    return re.findall(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|\w+|[^\s\w]', out.stdout)


def declarations(tokens):
    """Gives for each declaration at file level its tokens outside of brackets, and the names of enumerators."""
    depth, tokens_here, enumerators, kinds = 0, [], [], []
    for i, token in enumerate(tokens):
        if token in '([{':
            kinds.append('enum' if token == '{' and 'enum' in tokens[max(0, i - 2):i] else token)
            if depth == 0:
                tokens_here.append(token)
            depth += 1
        elif token in ')]}':
            depth -= 1
            kinds.pop()
            if depth == 0 and token == '}' and '(' in tokens_here and '=' not in tokens_here:
                yield tokens_here, enumerators
                tokens_here, enumerators = [], []
        elif depth == 0 and token == ';':
            yield tokens_here, enumerators
            tokens_here, enumerators = [], []
        elif depth == 0:
            tokens_here.append(token)
        elif kinds == ['enum'] and tokens[i - 1] in '{,':
            enumerators.append(token)


def file_level_names(tokens):
    """Returns the names that a text declares at file level, except external ones."""
    names = set()
    for words, enumerators in declarations(tokens):
        names.update(enumerators)
        while '__attribute__' in words:
            at = words.index('__attribute__')
            words = words[:at] + words[at + 2:]
        names.update(words[i + 1] for i in range(len(words) - 2)
                     if words[i] in ('struct', 'union', 'enum') and words[i + 2] == '{')
        head = words[:words.index('=')] if '=' in words else words
        if 'static' in words and '(' in head and '=' not in words:
            names.add(head[head.index('(') - 1])
        elif 'static' in words or 'typedef' in words:
            names.add([word for word in head if word not in '([{'][-1])
    return names


def check_macros(paths, sources):
    """Fails if a file uses the name of a macro of a header that it does not include, which petri.c would replace."""
    owners = {}
    for path in paths:
        if path.suffix == '.h' and not is_repeated(sources.lines(path)):
            for name in sources.macros(path):
                owners.setdefault(name, set()).add(path)
    for path in paths:
        if is_repeated(sources.lines(path)) and path.suffix == '.h':
            continue # a list, whose users define its macros
        visible = {path, *sources.closure(path)}
        text = re.sub(r'//.*|/\*.*?\*/|"(?:\\.|[^"\\])*"', '', '\n'.join(sources.lines(path)))
        own = set(re.findall(r'# *define (\w+)', text))
        for name in sorted(set(re.findall(r'\w+', text)) & owners.keys() - own):
            if not owners[name] & visible:
                fail(f'{path.relative_to(ROOT)} uses {name}, which is a macro of {min(owners[name]).relative_to(ROOT)}')


def set_macros(macros):
    """Returns lines that define the macros that a pass sets, again."""
    return [line for name, value in macros.items() for line in [f'#undef {name}', f'#define {name} {value}']]


def for_target(target, lines):
    """Returns lines whose functions are compiled for a set of instructions of x86-64."""
    return ['#if defined(__clang__)',
            f'#pragma clang attribute push(__attribute__((target("{target}"))), apply_to = function)', '#else',
            '#pragma GCC push_options', f'#pragma GCC target("{target}")', '#endif', *lines, '#if defined(__clang__)',
            '#pragma clang attribute pop', '#else', '#pragma GCC pop_options', '#endif']


def pass_lines():
    """Returns the lines with which petri.c includes itself, once per pass."""
    out = []
    for name, (target, macros) in PASSES.items():
        lines = set_macros(macros) + [f'#define PETRI_PASS {name}', '#include "petri.c"', '#undef PETRI_PASS']
        out += ['#if defined(PETRI_X86)', *for_target(target, lines), '#endif'] if target else lines
    return out


def kernel_names(before, kernel):
    """Returns the names that the kernels declare. `before` is the text before them."""
    names = set()
    for _, macros in PASSES.values():
        text = [*before, '#endif', *set_macros(macros), 'typedef int petri_marker;', *kernel]
        tokens = preprocessed(text, ['-D__x86_64__'])
        names |= file_level_names(tokens[tokens.index('petri_marker') + 2:])
    return sorted(names)


def make(build):
    """Returns the lines of petri.c."""
    sources = Sources(build)
    files = library_sources(build)
    kernels = [path for path in files if re.search(r'/(maths|arrays)_isa\.c$|/kernel_', str(path))]
    systems = [sources.find(name) for _, name in SYSTEMS]
    writer = Writer(sources, {m[1] for path in files + systems for m in map(OBJECT.match, sources.lines(path)) if m})
    writer.out += begin()
    for path in files + [PARTS / 'no_ranks.c']:
        if path not in kernels or path.name in ONE_LANE:
            writer.add(path)
    for (condition, _), path in zip(SYSTEMS, systems):
        writer.out.append(condition)
        writer.add(path)
    sha256 = Writer(sources, ())
    sha256.seen = writer.seen
    sha256.add(sources.find('base/sha256_isa.c'))
    writer.out += ['#endif', '#if defined(PETRI_X86)', *for_target('sha,sse4.1', sha256.out), '#endif']
    kernel, macros = kernel_text(kernels, writer)
    check_macros({path for path in writer.seen if path.name not in FOREIGN}, sources)
    undefined = ['#undef ' + name for name in macros]
    names = kernel_names(writer.out, undefined + kernel)
    return [*writer.out, *part('passes.c'), *pass_lines(), '', '#else // a pass', *undefined,
            *(f'#define {name} PETRI_NAMED({name})' for name in names), *kernel, *('#undef ' + name for name in names),
            '#endif']


def begin():
    """Returns the first part of petri.c, with version and licence."""
    version = re.search(r"version: '([^']+)'", (ROOT / 'meson.build').read_text())[1]
    lines = [line.replace('@VERSION@', version) for line in part('begin.c')]
    licence = ['//' + (' ' + line if line else '') for line in ['', *(ROOT / 'LICENSE').read_text().splitlines()]]
    at = next(i for i, line in enumerate(lines) if not line.startswith('//'))
    return lines[:at] + licence + lines[at:]


def part(name):
    return (PARTS / name).read_text(encoding='utf-8').splitlines()


def main():
    build, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'petri.c').write_text('\n'.join(make(build)) + '\n', encoding='utf-8')
    for name in PUBLIC:
        shutil.copyfile(ROOT / 'lib/include' / name, folder / name)
    shutil.copyfile(PARTS / 'check_report.c', folder / 'check_report.c')


main()

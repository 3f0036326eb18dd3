"""digest.py: computes digests of states as specified in lib/spec/digest.md, independently of petri.

digest.py EXAMPLES PETRI SCRIPT...: checks the examples in a file, and the digests that petri prints for scripts.
digest.py EXAMPLES --update: replaces the digests in the file.
"""
import re
import struct
import subprocess
import sys

try:
    import xxhash
except ImportError:
    print('skipped: no xxhash for Python (Debian: python3-xxhash)')
    sys.exit(77)

CHUNK = 4096
ELEMENT = re.compile(r"""'((?:[^'\\]|\\.)*)'|"((?:[^"\\]|\\.)*)"|:([^;) ]+)|([^;) ]+)""")
ESCAPES = {'n': '\n', 't': '\t', 'r': '\r', '0': '\0'}


def symbol(name):
    """Returns the number of a symbol (language.md L4.3)."""
    bits = 0xcbf29ce484222325
    for character in name:
        bits = (bits ^ ord(character)) * 0x100000001b3 % 2**64
    return struct.unpack('<d', struct.pack('<Q', 0xffe << 52 | bits >> 12))[0]


def read_vector(text, at):
    """Reads a vector such as `:a;1` that begins at an index. Returns it with the index of its end."""
    vector = []
    while True:
        match = ELEMENT.match(text, at)
        single, double, name, number = match.groups()
        if name:
            vector.append(symbol(name))
        elif not number:
            string = re.sub(r'\\(.)', lambda escape: ESCAPES.get(escape[1], escape[1]), single or double or '')
            vector.append(string.encode())
        elif number != 'null':
            vector.append(float(number))
        at = match.end() + 1
        if text[match.end():at] != ';':
            return vector, match.end()


def read_entry(line):
    """Reads a line such as `$(:a;1) = 2;3` of the output of --print state. Returns key and value."""
    parentheses = line.startswith('$(')
    key, at = read_vector(line, 1 + parentheses)
    return key, read_vector(line, at + parentheses + len(' = '))[0]


def words(*numbers):
    return struct.pack(f'<{len(numbers)}Q', *numbers)


def string_words(text):
    return words(2**64 - 1, len(text)) + text + bytes(-len(text) % 8)


def element(item):
    return string_words(item) if isinstance(item, bytes) else struct.pack('<d', item)


def item_order(item):
    if isinstance(item, bytes):
        return 1, item
    return 0, item, str(item)[0] != '-'


def value_shape(value):
    if not any(isinstance(item, bytes) for item in value):
        return words(len(value))
    return words(2**63 + len(value)) + b''.join(string_words(i) if isinstance(i, bytes) else words(0) for i in value)


def digest(entries):
    """Returns the digest of a list of pairs of key and value, which are lists of numbers and bytes."""
    entries = sorted(entries, key=lambda entry: [item_order(item) for item in entry[0]])
    shape = b''.join(words(len(key)) + b''.join(map(element, key)) + value_shape(value) for key, value in entries)
    numbers = [item for _, value in entries for item in value if not isinstance(item, bytes)]
    chunks = [numbers[i:i + CHUNK] for i in range(0, len(numbers), CHUNK)]
    head = words(1, len(entries), len(numbers)) + xxhash.xxh3_128_digest(shape)
    return xxhash.xxh3_128_hexdigest(
        head + b''.join(xxhash.xxh3_128_digest(struct.pack(f'<{len(c)}d', *c)) for c in chunks))


def check_examples(path, update):
    """Checks a file of states, each preceded by a line `= DIGEST`. Other lines are comments."""
    with open(path, encoding='utf-8') as file:
        blocks = re.split(r'(?m)^(= .*\n)', file.read())
    for i in range(1, len(blocks), 2):
        found = f'= {digest([read_entry(line) for line in blocks[i + 1].splitlines() if line.startswith("$")])}\n'
        if found != blocks[i] and not update:
            sys.exit(f'{path}: {blocks[i].strip()} should be {found.strip()}')
        blocks[i] = found
    if update:
        with open(path, 'w', encoding='utf-8') as file:
            file.write(''.join(blocks))


def check_script(petri, script):
    """Checks some frames of a script."""
    command = [petri, 'run', script, '--frames', '13', '--every', '3', '--print', 'state,digest']
    output = subprocess.run(command, check=True, capture_output=True, encoding='utf-8').stdout
    frames = re.split(r'(?m)^@.*\n', output)[1:]
    for frame in frames:
        lines = frame.splitlines()
        found = digest([read_entry(line) for line in lines if line.startswith('$')])
        if lines[-1] != f'= {found}':
            sys.exit(f'{script}: {lines[-1]} should be = {found}')
    if not frames:
        sys.exit(f'{script}: no frames')


if sys.argv[2] == '--update':
    check_examples(sys.argv[1], True)
else:
    check_examples(sys.argv[1], False)
    for name in sys.argv[3:]:
        check_script(sys.argv[2], name)

#!/usr/bin/env python3
"""check_circles.py SOURCE_ROOT BUILD_ROOT: the files of a room call each other in one direction, in few levels.

A room is a folder of lib/ or src/. A circle is a set of files of which each reaches each other by calls or by data, as the
symbols of their object files say. A circle of at most three files may be one algorithm. The depth of a room is the number of
files on its longest way of calls, in which a circle counts as all of its files.
"""
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

MAX_FILES = 3
MAX_DEPTH = 8


def object_files(build):
    """Yields (room, file, path) for each object file of lib/ and src/ in the build."""
    listed = subprocess.run(['ninja', '-C', build, '-t', 'deps'], capture_output=True, text=True, check=True).stdout
    for path in re.findall(r'^((?:lib|src)/\S+\.o): ', listed, re.M):
        parts = path.split('/')
        name = re.sub(r'^meson-generated_.*', '', parts[-1])
        if not name or not Path(build, path).is_file():
            continue
        if parts[0] == 'lib':
            yield 'lib/' + parts[1], name[:-2], path
        elif '_' in name:
            room, file = name[:-2].split('_', 1)
            yield 'src/' + room, file, path


def read_calls(build):
    """Returns {room: {file: set of files of the room that it uses}}."""
    owner, uses, room_of = {}, defaultdict(set), {}
    objects = {path: (room, file) for room, file, path in object_files(build)}
    output = subprocess.run(['nm', '-gA', *objects], cwd=build, capture_output=True, text=True, check=True).stdout
    for line in output.splitlines():
        path, rest = line.split(':', 1)
        *_, kind, name = rest.split()
        if kind == 'U':
            uses[objects[path]].add(name)
        else:
            owner.setdefault(name, objects[path])
    calls = defaultdict(lambda: defaultdict(set))
    for (room, file), names in uses.items():
        for name in names:
            if name in owner and owner[name][0] == room and owner[name][1] != file:
                calls[room][file].add(owner[name][1])
    return calls


def circles(calls):
    """Returns the strongly connected components (Tarjan's algorithm), each after those that it calls."""
    number, low, stack, found = {}, {}, [], []

    def visit(file):
        number[file] = low[file] = len(number)
        stack.append(file)
        for other in sorted(calls.get(file, ())):
            if other not in number:
                visit(other)
            if other in stack:
                low[file] = min(low[file], low[other])
        if low[file] == number[file]:
            start = stack.index(file)
            found.append(sorted(stack[start:]))
            del stack[start:]

    for file in sorted(calls):
        if file not in number:
            visit(file)
    return found


def longest_way(calls, components):
    """Returns the longest way of calls, as a list of files; `components` are those of `circles`, those called before others."""
    ways = {}
    for component in components:
        below = [ways[other] for file in component for other in calls.get(file, ()) if other not in component]
        for file in component:
            ways[file] = component + max(below, key=len, default=[])
    return max(ways.values(), key=len)


def main():
    calls, wrong = read_calls(sys.argv[2]), 0
    if len(calls) < 20:
        sys.exit(f'check_circles: found only {len(calls)} rooms')
    for room in sorted(calls):
        components = circles(calls[room])
        largest, way = max(components, key=len), longest_way(calls[room], components)
        if len(largest) > MAX_FILES:
            print(f'{room}: {len(largest)} files call each other in a circle, and at most {MAX_FILES} may:', *largest)
            wrong += 1
        if len(way) > MAX_DEPTH:
            print(f'{room}: {len(way)} files are on one way of calls, and at most {MAX_DEPTH} may be:', *way)
            wrong += 1
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.setrecursionlimit(10000)
    sys.exit(main())

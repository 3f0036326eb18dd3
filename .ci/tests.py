#!/usr/bin/env python3
"""tests.py BUILD [--all | NAME...]: chooses tests of a configured build folder for `./dev test`.

A NAME is a test or a suite. Without names, chooses all that are not in the suite `thorough`; with --all, all. Both leave
out the suite `scripts`, whose folders of scripts dev runs itself. Prints a line for each fact, tests in the order in
which meson starts them:
    test NAME    a chosen test
    target PATH  what the chosen tests need, for ninja; without names and with --all, nothing, because they need everything
    unknown NAME a NAME that is neither a test nor a suite
"""
import json
import os
import sys
from pathlib import Path

# Programs that petri starts: tests of petri may need any of them.
HELPERS = ('petri-pictures', 'petri-hdf5', 'petri-ranks')


def suites_of(test):
    return [suite.split(':')[-1] for suite in test['suite']]


def targets_of(build, tests):
    """Returns the paths of the files that the tests need, relative to the build folder; 'all' if they read the folder."""
    targets = {target['id']: target for target in json.loads((build / 'meson-info/intro-targets.json').read_text())}
    helpers = [id for id, target in targets.items() if target['name'] in HELPERS and target['type'] == 'executable']
    needed = []
    for test in tests:
        if str(build) in test['cmd']:
            return ['all']
        needed += test['depends']
        if any(targets[id]['name'] == 'petri' for id in test['depends']):
            needed += helpers
    files = [file for id in dict.fromkeys(needed) for file in targets[id]['filename']]
    return [os.path.relpath(file, build) for file in files]


def main():
    build = Path(sys.argv[1]).resolve()
    names = sys.argv[2:]
    everything = names == ['--all']
    tests = json.loads((build / 'meson-info/intro-tests.json').read_text())
    chosen = []
    for test in tests:
        words = {test['name'], *suites_of(test)}
        omitted = {'scripts'} if everything else {'scripts', 'thorough'}
        if words & set(names) if names and not everything else not words & omitted:
            chosen.append(test)
    for test in chosen:
        print('test', test['name'])
    if names and not everything:
        for target in targets_of(build, chosen):
            print('target', target)
        known = {word for test in tests for word in [test['name'], *suites_of(test)]}
        for name in names:
            if name not in known:
                print('unknown', name)


main()

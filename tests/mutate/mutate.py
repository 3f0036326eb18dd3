#!/usr/bin/env python3
"""mutate.py ROOT PATH... [--count N] [--seed N] [--only N,N...]: plants faults one at a time and reports which the tests catch.

The faults are a random sample of those that faults.py finds in the files of the PATHs; the same sources and seed give the
same sample. Each worker has a copy of the project with a build in ROOT/build-mutate, so a fault costs one object and the
links of the tests. Faults that do not compile, and those with the same object code as the original, are replaced by others.
"""
import argparse
import difflib
import filecmp
import itertools
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections import Counter, namedtuple
from pathlib import Path

from faults import faults_of, plant

# The suites and tests of a folder, the first of which is its own. Own suites run first, then the corpora of scripts, then
# the others, quick ones before slow ones. Other folders: the suite with the folder's name, and the corpora.
SUITES = {
    'lib/physics': ['physics', 'scene', 'session'],
    'lib/ranks': ['test_session_ranks', 'test_hilbert'],
    'lib/vm': ['vm', 'program', 'session', 'simplifier', 'batches', 'memory', 'repl_sessions', 'cli'],
    'lib/program': ['program', 'vm', 'session', 'simplifier', 'batches', 'memory', 'repl_sessions', 'cli'],
    'lib/state': ['state', 'session', 'scene', 'memory', 'repl_sessions', 'cli'],
    'lib/session': ['session', 'state', 'scene', 'memory', 'repl_sessions', 'cli'],
    'grammar': ['syntax', 'program', 'vm', 'session', 'memory', 'repl_sessions', 'cli'],
    'lib/syntax': ['syntax', 'program', 'vm', 'session', 'memory', 'repl_sessions', 'cli'],
    **dict.fromkeys(['lib/picture', 'lib/cairo'], ['draw', 'pictures', 'canvas', 'gl', 'memory', 'cli']),
    'lib/scene3d': ['gl', 'draw', 'pictures', 'memory', 'cli'],
}
CORPORA = 'scripts'
SLOW = 4  # tests that take more seconds run only if mutants are tried again (--only)
SKIPPED = 77  # exit status of a test that cannot run here
MEMORY = 4 << 30  # address space of a test, in bytes

Test = namedtuple('Test', 'name command environment folder suites targets')
Mutant = namedtuple('Mutant', 'number path fault text')


def sources_of(root, paths):
    """Returns the C, bison and re2c sources of files and folders, relative to the root."""
    found = []
    for path in paths:
        whole = root / path
        files = [whole] if whole.is_file() else whole.rglob('*')
        found += [str(f.relative_to(root)) for f in files if f.suffix in ('.c', '.h', '.y', '.re')]
    return sorted(set(found))


def sample(root, paths, seed):
    """Yields all mutants of the sources in a random order that depends only on the sources and the seed."""
    mutants = []
    for path in sources_of(root, paths):
        text = (root / path).read_text(encoding='utf8')
        mutants += [(path, fault, text) for fault in faults_of(text, path.endswith(('.y', '.re')))]
    random.Random(seed).shuffle(mutants)
    for number, mutant in enumerate(mutants, 1):
        yield Mutant(number, *mutant)


def copy_sources(root, folder):
    """Copies changed files that git tracks or would add, and removes those that are gone, so that builds are incremental."""
    listed = subprocess.run(['git', '-C', root, 'ls-files', '-co', '--exclude-standard'], capture_output=True, text=True,
                            check=True)
    wanted = set(listed.stdout.splitlines())
    for name in wanted:
        old, new = root / name, folder / name
        if old.is_file() and not (new.exists() and filecmp.cmp(old, new, shallow=False)):
            new.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(old, new)
    for old in [p for p in folder.rglob('*') if p.is_file()]:
        name = old.relative_to(folder)
        if name.parts[0] != 'build' and str(name) not in wanted and not old.name.endswith('.pyc'):
            old.unlink()


class Checkout:
    """A copy of the project with a build. All but the first are copies of the first, with its paths in meson's files."""

    def __init__(self, root, number):
        self.first = root / 'build-mutate/1'
        self.folder = root / f'build-mutate/{number}'
        self.build = self.folder / 'build'

    def copy_first(self):
        """Replaces this checkout by a copy of the first."""
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.first, self.folder, symlinks=True)

    def prepare(self, root):
        """Copies the sources and configures the build if necessary; ends the program if that fails."""
        copy_sources(root, self.folder)
        if not (self.build / 'build.ninja').exists():
            self.call('meson', 'setup', self.build, self.folder, '--buildtype=plain', '--optimization=1')
        self.call('ninja', '-C', self.build, 'build.ninja')  # new tests are known only after that

    @staticmethod
    def call(*command):
        """Runs a command; ends the program if it fails."""
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode:
            sys.exit(done.stdout[-4000:] + f'mutate: failed: {" ".join(map(str, command))}')

    def compiles(self, targets):
        """Returns whether ninja can build the targets."""
        return subprocess.run(['ninja', '-C', self.build, *targets], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0

    def objects(self):
        """Returns the contents of the compiled object files of each C source: {source: {object: bytes}}, with relative paths."""
        commands = json.loads((self.build / 'compile_commands.json').read_text(encoding='utf8'))
        found = {}
        for command in commands:
            source, compiled = os.path.relpath(self.build / command['file'], self.folder), self.build / command['output']
            if compiled.exists():
                found.setdefault(source, {})[command['output']] = compiled.read_bytes()
        return found

    def tests(self, suites):
        """Returns the tests with these names or in these suites."""
        shown = subprocess.run(['meson', 'introspect', self.build, '--tests', '--targets'], capture_output=True, text=True,
                               check=True)
        shown = json.loads(shown.stdout.replace(f'{self.first}/', f'{self.folder}/'))
        files = {t['id']: [os.path.relpath(f, self.build) for f in t['filename']] for t in shown['targets']}
        known, found = set(itertools.chain(*files.values())), []
        for test in shown['tests']:
            names = {part.split(':')[-1] for part in test['suite']}
            targets = [f for t in test['depends'] if t in files for f in files[t]]
            targets += [os.path.relpath(c, self.build) for c in test['cmd'] if c.startswith(f'{self.build}/')]
            if 'src/petri' in targets:
                targets.append('src/petri-pictures')
            found.append(Test(test['name'], test['cmd'], test['env'], test['workdir'] or str(self.build), names,
                              sorted(known & set(targets))))
        return [t for t in found if suites & (t.suites | {t.name})]


def run_test(test, seconds):
    """Runs a test in the environment of all tests; returns whether it passes. `seconds`: limit of processor time."""

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    root = Path(test.folder)
    while not (root / '.ci').exists():
        root = root.parent
    with subprocess.Popen([root / '.ci/clean-env', *test.command], cwd=test.folder, env={**os.environ, **test.environment},
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          start_new_session=True, preexec_fn=limit) as process:
        try:
            return process.wait(timeout=2 * seconds) in (0, SKIPPED)
        except subprocess.TimeoutExpired:
            return False
        finally:
            try:  # also ends what the test left behind
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass


class Worker:
    """Tries mutants in its checkout."""

    def __init__(self, checkout, groups, limits):
        self.checkout, self.groups, self.limits = checkout, groups, limits
        self.originals = checkout.objects()  # without a fault

    def changes_code(self, mutant):
        """Compiles the mutant alone; returns whether its object code differs, None if it does not compile or is not built."""
        objects = self.originals.get(mutant.path, {})
        if not objects and mutant.path.endswith('.c'):
            return None  # a source for builds without a library
        (self.checkout.folder / mutant.path).write_text(plant(mutant.text, mutant.fault), encoding='utf8')
        if objects and not self.checkout.compiles(objects):
            return None
        return not objects or any((self.checkout.build / o).read_bytes() != old for o, old in objects.items())

    def judge(self, mutant):
        """Returns the name of the test that catches the mutant, 'survived', 'not compiled' or 'same code'."""
        try:
            differs = self.changes_code(mutant)
            if not differs:
                return 'not compiled' if differs is None else 'same code'
            for tests in self.groups:
                if not self.checkout.compiles([t for test in tests for t in test.targets]):
                    return 'not compiled'
                for test in tests:
                    if not run_test(test, self.limits[test.name]):
                        return test.name
            return 'survived'
        finally:  # the next mutant compiles this source again
            (self.checkout.folder / mutant.path).write_text(mutant.text, encoding='utf8')


def difference(mutant):
    """Returns the fault as a unified diff."""
    lines = difflib.unified_diff(mutant.text.splitlines(True), plant(mutant.text, mutant.fault).splitlines(True),
                                 f'a/{mutant.path}', f'b/{mutant.path}', n=2)
    return ''.join(lines)


class Survey:
    """Shares the mutants among the workers and counts the results."""

    def __init__(self, mutants, count):
        self.mutants, self.count = mutants, count
        self.results, self.lock, self.pending = Counter(), threading.Lock(), 0
        self.error = None

    def take(self):
        """Returns the next mutant; None if there are enough."""
        with self.lock:
            if self.error or self.done() + self.pending >= self.count:
                return None
            mutant = next(self.mutants, None)
            self.pending += mutant is not None
            return mutant

    def done(self):
        """Returns the number of mutants that count."""
        return self.results['caught'] + self.results['survived']

    def report(self, mutant, result):
        """Counts a result and prints it."""
        with self.lock:
            self.pending -= 1
            kind = result if result in ('survived', 'not compiled', 'same code') else 'caught'
            self.results[kind] += 1
            print(f'{self.done():4}/{self.count} mutant {mutant.number}: {mutant.path}:{mutant.fault.line}: '
                  f'{mutant.fault.kind}: {result}', flush=True)
            if result == 'survived':
                print(difference(mutant), flush=True)

    def work(self, worker):
        """Lets a worker try mutants until there are enough."""
        try:
            # The last mutants of other workers may turn out not to count.
            while mutant := self.take():
                self.report(mutant, worker.judge(mutant))
        except Exception as error:  # must end the other workers too
            self.error = error
            raise


def measure(tests, own, slow):
    """Runs the tests without a fault. Returns their names in the groups that are compiled and run one after the other (those of
    the suites `own`, the corpora, the others; quick ones first) and a limit of seconds for each. `slow`: keep slow tests.
    Ends the program if one fails.
    """
    seconds = {}
    for test in tests:
        start = time.monotonic()
        if not run_test(test, 600):
            sys.exit(f'mutate: {test.name} fails without a fault')
        seconds[test.name] = time.monotonic() - start
    kept = [t for t in tests if slow or own & t.suites or CORPORA in t.suites or seconds[t.name] <= SLOW]
    ordered = sorted(kept, key=lambda t: seconds[t.name])
    groups = [[t.name for t in ordered if own & t.suites],
              [t.name for t in ordered if CORPORA in t.suites and not own & t.suites],
              [t.name for t in ordered if CORPORA not in t.suites and not own & t.suites]]
    return groups, {name: 5 + int(3 * duration) for name, duration in seconds.items()}


def suites_of(paths):
    """Returns the own suites of files and folders of the project, and all names of suites and tests that test them."""
    own, found = set(), {CORPORA}
    for path in paths:
        folder = next((f for f in SUITES if path == f or path.startswith(f + '/')), path)
        names = SUITES.get(folder, [Path(folder).name])
        own.add(names[0])
        found.update(names)
    return own, found


def main():
    """Runs the command."""
    parser = argparse.ArgumentParser(description='Plants faults and reports which the tests catch.')
    parser.add_argument('root', type=Path)
    parser.add_argument('paths', nargs='+', metavar='PATH')
    parser.add_argument('--count', type=int, default=150)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only', default='', help='numbers of mutants to try again')
    options = parser.parse_args()
    root = options.root.resolve()
    paths = [os.path.relpath(path, root) for path in options.paths]
    mutants = sample(root, paths, options.seed)
    if options.only:
        wanted = {int(n) for n in options.only.split(',')}
        mutants = iter([m for m in mutants if m.number in wanted])
        options.count = len(wanted)
    own, suites = suites_of(paths)
    first = Checkout(root, 1)
    first.prepare(root)
    tests = first.tests(suites)
    if not any(CORPORA not in test.suites for test in tests):
        sys.exit(f'mutate: no suite tests {", ".join(paths)}')
    targets = sorted({t for test in tests for t in test.targets})
    first.call('ninja', '-C', first.build, *targets)
    groups, limits = measure(tests, own, bool(options.only))
    workers = []
    for number in range(1, (os.cpu_count() or 1) + 1):
        checkout = Checkout(root, number)
        if number > 1:
            checkout.copy_first()
        tests = {t.name: t for t in checkout.tests(suites)}
        workers.append(Worker(checkout, [[tests[name] for name in group] for group in groups], limits))
    survey = Survey(mutants, options.count)
    threads = [threading.Thread(target=survey.work, args=(worker,)) for worker in workers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if survey.error:
        sys.exit(f'mutate: {survey.error}')
    caught, done = survey.results['caught'], survey.done()
    print(f'{", ".join(paths)}: {caught} of {done} caught ({100 * caught / max(done, 1):.1f} %), '
          f'{survey.results["survived"]} survived, {survey.results["not compiled"]} did not compile, '
          f'{survey.results["same code"]} with the same code')


if __name__ == '__main__':
    main()

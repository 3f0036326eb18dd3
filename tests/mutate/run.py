#!/usr/bin/env python3
"""run.py: tests of `./dev mutate`: the faults that faults.py finds, and their judgement in a small project."""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from faults import faults_of, plant

ROOT = Path(__file__).parents[2]

SOURCE = '''#include "sum.h"
static void store(int *place, int x) {
    *place = x + 1;
}
int limit(int x, int limits[3], int unused) {
    if (x < 0) // not tested at the border
        return 0;
    while (unused > 0)
        unused--;
    store(&limits[x], x);
    return limits[x] + 0;
}
'''
HEADER = 'int limit(int x, int limits[3], int unused);\n'
TEST = '''#include <stdlib.h>
#include "sum.h"
int main(void) {
    int limits[3] = {0, 0, 0};
    return limit(-1, limits, 0) == 0 && limit(1, limits, 1) == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
'''
NOT_BUILT = 'int other(int a) { return a + 1; }\n'
BUILD = '''project('small', 'c', default_options: ['werror=true', 'warning_level=3'])
sum = static_library('sum', 'lib/sum/sum.c')
test('test_sum', executable('test_sum', 'test_sum.c', include_directories: 'lib/sum', link_with: sum), suite: 'sum')
'''


def changes(text, grammar=False):
    """Returns the faults of a source as pairs of the old and the new text."""
    return [(text[f.start:f.end], f.new) for f in faults_of(text, grammar)]


class Faults(unittest.TestCase):
    """What faults.py finds."""

    def body(self, text):
        """Returns the changes of a function's body."""
        return changes(f'void f(int *x) {{\n    {text}\n}}\n')

    def test_operators(self):
        self.assertEqual(self.body('return a << b;'), [('<<', '>>')])
        self.assertIn(('&&', '||'), self.body('return a && b;'))
        self.assertIn(('*', '/'), self.body('return a * b;'))
        self.assertIn(('!', ''), self.body('return !a;'))
        self.assertIn(('+=', '-='), self.body('a->b += c;'))

    def test_pointers_are_no_products(self):
        self.assertEqual(self.body('Thing *thing = &other;'), [])

    def test_constants(self):
        self.assertEqual(self.body('return 0;'), [('0', '1')])
        self.assertEqual(self.body('return 1u;'), [('1u', '0u')])
        self.assertEqual(self.body('return 0x10;'), [('0x10', '(0x10 + 1)')])
        self.assertEqual(self.body('return true;'), [('true', 'false')])
        self.assertEqual(self.body("return 'a';"), [("'a'", "('a' + 1)")])

    def test_conditions(self):
        self.assertEqual(self.body('if (a(b))\n return;'), [('a(b)', '!(a(b))'), ('return', '')])

    def test_statements(self):
        self.assertIn(('x[3] = y', ''), self.body('x[3] = y;'))
        self.assertIn(('*x = y', ''), self.body('*x = y;'))
        self.assertIn(('((int *)x)[0] = y', ''), self.body('((int *)x)[0] = y;'))
        self.assertIn(('x++', ''), self.body('x++;'))
        self.assertEqual(self.body('break;'), [('break', '')])
        self.assertEqual(self.body('Type x = {{y}};'), [])
        self.assertEqual(self.body('for (; *x;)\n y;'), [('y', '')])

    def test_arguments(self):
        self.assertEqual(self.body('return f(a, g(b, c), a);'), [('a, g(b, c)', 'g(b, c), a'),
                                                                 ('g(b, c), a', 'a, g(b, c)'), ('b, c', 'c, b')])
        self.assertEqual(self.body('return f(a, a);'), [])

    def test_what_has_no_faults(self):
        self.assertEqual(changes('enum { A = 1 };\nstatic const int x[] = {1, 2 + 3};\n#define F(a) (a + 1)\n'), [])
        self.assertEqual(self.body('assert(a < b); // a < b\n    /* 1 */ return "1 < 2";'), [])

    def test_grammars(self):
        self.assertEqual(changes('%code {\nint f(int a) { return a + b; }\n}\n%%\nrule: word { $$ = f($1, 2); };\n', True),
                         [('+', '-'), ('$$ = f($1, 2)', ''), ('$1, 2', '2, $1'), ('2', '(2 + 1)')])

    def test_plant(self):
        text = 'int f(int a) { return a - 2; }'
        self.assertEqual([plant(text, f) for f in faults_of(text)],
                         ['int f(int a) { return a + 2; }', 'int f(int a) { return a - (2 + 1); }'])


class Judgement(unittest.TestCase):
    """What mutate.py says about the faults of a small project."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        files = {'lib/sum/sum.c': SOURCE, 'lib/sum/sum.h': HEADER, 'lib/sum/other.c': NOT_BUILT, 'test_sum.c': TEST,
                 'meson.build': BUILD}
        for name, text in files.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(text, encoding='utf8')
        (self.folder / '.ci').mkdir()
        shutil.copy(ROOT / '.ci/clean-env', self.folder / '.ci')
        subprocess.run(['git', 'init', '-q', self.folder], check=True)

    def mutate(self, *options):
        """Runs mutate.py; returns its process."""
        return subprocess.run([sys.executable, ROOT / 'tests/mutate/mutate.py', self.folder, *options], capture_output=True,
                              text=True, check=False, cwd=self.folder)

    def test_all_faults(self):
        done = self.mutate('lib/sum', '--count', '100')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        results = dict(re.findall(r'mutant (\d+): lib/sum/sum.c:\d+: \w+: (.*)', done.stdout))
        self.assertEqual(len(results), len(faults_of(SOURCE)))
        self.assertIn('not compiled', results.values())  # swapped arguments of store
        self.assertIn('-    if (x < 0) // not tested at the border\n+    if (x <= 0) //', done.stdout)
        self.assertIn('same code', results.values())  # - 0
        self.assertEqual(set(re.findall(r'lib/sum/other.c:1: \w+: (.*)', done.stdout)), {'not compiled'})
        # A fault in the result is caught.
        caught = sum(result == 'test_sum' for result in results.values())
        survived = sum(result == 'survived' for result in results.values())
        self.assertRegex(done.stdout, rf'lib/sum: {caught} of {caught + survived} caught \(\d+\.\d %\), {survived} survived')
        self.assertGreaterEqual(caught, 5)
        self.assertEqual(done.stdout.count('\n--- a/lib/sum/sum.c\n'), survived)
        self.assertEqual((self.folder / 'lib/sum/sum.c').read_text(encoding='utf8'), SOURCE)

        survivors = [number for number, result in results.items() if result == 'survived']
        again = self.mutate('lib/sum', '--only', ','.join(survivors))
        self.assertIn(f'lib/sum: 0 of {survived} caught', again.stdout)

        (self.folder / 'test_sum.c').write_text(TEST.replace('== 0 &&', '== 0 && limit(0, limits, 0) == 1 &&'), encoding='utf8')
        again = self.mutate('lib/sum', '--only', ','.join(survivors))
        self.assertNotIn('x <= 0', again.stdout)

    def test_a_failing_test(self):
        (self.folder / 'test_sum.c').write_text(TEST.replace('== 2', '== 3'), encoding='utf8')
        done = self.mutate('lib/sum', '--count', '1')
        self.assertIn('test_sum fails without a fault', done.stderr)
        self.assertEqual(done.returncode, 1)


if __name__ == '__main__':
    unittest.main()

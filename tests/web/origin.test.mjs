// origin.test.mjs: tests which lines of a script are said to make a particle. panels.test.mjs tests that the page shows them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { originsOf } from '../../src/web/page/origin.mjs';
import { root } from './browser.mjs';

const SCRIPT = `-- !physics state=:p
!physics state=:p dimensions=2 -- !particle id=7
    !anchor id=:middle position=0;0
    for i in ..3
        !particle id=i position=60*i-60;0 radius=20
        !group
            !anchor id=9 position=0;"!particle id=8"
!physics state=:q dimensions=2
    for i in ..2
        if i
            !particle id=i
        else
            !particle id=(i;1)
`;

test('a constant id names its line, and other ids name the lines with expressions', () => {
    assert.deepEqual(originsOf(SCRIPT, ':p', ':middle'), [{ line: 3, column: 5 }]);
    assert.deepEqual(originsOf(SCRIPT, ':p', '9'), [{ line: 7, column: 13 }]);
    assert.deepEqual(originsOf(SCRIPT, ':p', '2'), [{ line: 5, column: 9 }]);
    assert.deepEqual(originsOf(SCRIPT, ':q', '1'), [{ line: 11, column: 13 }, { line: 13, column: 13 }]);
    assert.deepEqual(originsOf(SCRIPT, ':r', '1'), []);
    assert.deepEqual(originsOf('!physics state=(:a;1)\n    !particle id=1\n', ':a;1', '1'), [{ line: 2, column: 5 }]);
});

test('lines are found in the samples', () => {
    const dish = readFileSync(join(root, 'samples/dish.fl'), 'utf8'), lineOf = found => dish.split('\n')[found[0].line - 1];
    assert.match(lineOf(originsOf(dish, ':drops', ':spoon')), /!anchor id=:spoon/);
    assert.match(lineOf(originsOf(dish, ':drops', '3')), /!particle id=/);
});

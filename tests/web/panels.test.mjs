// panels.test.mjs: the prompt, plot and table, completion and help, and narrow screens.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { atFrame, opened, options, seek, typed } from './browser.mjs';

const NOW = '!counter state=:c rate=1\n!window size=8;8\n    !canvas\n';

async function running(page, text) {
    await typed(page, text);
    await page.evaluate(() => delete document.body.dataset.frame);
    await page.keyboard.press('Control+Enter');
    await page.waitForFunction(() => Number(document.body.dataset.frame) > 3);
    await page.click('#run');
    await page.waitForFunction(() => document.getElementById('run').textContent === 'Run');
}

test('the prompt has definitions, errors and a history', options, () => opened('', {
    use: async page => {
        const ask = async (text, answer) => {
            await page.fill('#line', text);
            await page.press('#line', 'Enter');
            await page.waitForFunction(wanted => document.getElementById('printed').textContent.endsWith(wanted), answer);
        };
        await ask('let q=6', '? let q=6\n');
        await ask('q*7', '42\n');
        await page.fill('#line', 'coss(1)');
        await page.press('#line', 'Enter');
        await page.waitForFunction(() => /unbound name 'coss'/.test(document.getElementById('printed').textContent));
        await page.press('#line', 'ArrowUp');
        await page.press('#line', 'ArrowUp');
        assert.equal(await page.inputValue('#line'), 'q*7');
        await page.press('#line', 'ArrowDown');
        assert.equal(await page.inputValue('#line'), 'coss(1)');
    },
}));

const prompted = page => page.evaluate(() => document.getElementById('printed').textContent);

// Enters a line, and returns what was printed after it.
async function entered(page, line) {
    const before = (await prompted(page)).length;
    await page.fill('#line', line);
    await page.press('#line', 'Enter');
    const echo = `? ${line}\n`;
    await page.waitForFunction(([length, text]) => {
        const printed = document.getElementById('printed').textContent.slice(length);
        return printed.startsWith(text) && printed.length > text.length;
    }, [before, echo]);
    return (await prompted(page)).slice(before + echo.length);
}

test('the prompt has the commands of petri repl', options, () => opened('', {
    use: async page => {
        await running(page, 'let SIZE=SIZE or 3 -- 1..9 how large\n!counter state=:c rate=1\n'
            + '!physics state=:p dimensions=2\n    !particle id=7 position=0;0 velocity=SIZE;4 radius=1\n    !drag strength=0\n'
            + '!window size=8;8\n    !canvas\n');
        assert.match(await entered(page, '.reset'), /^@0 time=0 beat=0\n$/);
        await atFrame(page, 0);
        assert.match(await entered(page, '.step 2*5'), /^@10 /);
        await atFrame(page, 10);
        assert.match(await entered(page, '.back'), /^@9 /);
        assert.match(await entered(page, '.goto 30'), /^@30 /);
        assert.match(await entered(page, '.until frame >= 40'), /^@40 /);
        assert.match(await entered(page, '.until frame < 0 --limit 5'), /^@45 [^\n]*\nthe condition was not true within 5 frames/);
        assert.match(await entered(page, '.run 0.1'), /^@51 /);
        await atFrame(page, 51);
        assert.match(await entered(page, '.back 100'), /^-- went back only 51 frames: this is the start\n@0 /);
        assert.match(await entered(page, '.back'), /^cannot go back: this is the start\n$/);
        await entered(page, '.step 3');
        assert.match(await entered(page, '.state c'), /^\$:c = [^\n]*\n/);
        assert.match(await entered(page, '.tree drag'), /^!drag strength=0\n$/);
        assert.match(await entered(page, '.particles'), /^:p: 1 particle\nid +position +velocity +speed +force\n7 .* 3;4 +5 +/);
        assert.match(await entered(page, '.energy p'), /kinetic energy +12\.5\n {2}momentum +3;4\n/);
        assert.match(await entered(page, '.why 7'), /^:p;7: \d contribution/);
        assert.match(await entered(page, '.set SIZE 6'), /^-- SIZE = 6 {2}\(1\.\.9, default 3\) {2}how large\n$/);
        await page.waitForFunction(() => document.getElementById('parameter-SIZE').value === '6');
        assert.match(await entered(page, '.parameters'), /^SIZE {2}6 \(default 3\) {2}1\.\.9 {2}how large\n$/);
        assert.match(await entered(page, '.tempo'), /^tempo = 120\n$/);
        assert.match(await entered(page, '.time 2+2'), /^-- .* [mun]?s, the fastest/);
        assert.match(await entered(page, '.help .step'), /^\.step \[N\]\n {4}compute N frames/);
        assert.match(await entered(page, '.help polar'), /^polar\(x\)/);
        assert.match(await entered(page, '.help'), /\.until EXPR \[--limit N\]/);
        assert.match(await entered(page, '.drop'), /^-- 0 statements removed\n$/);
        assert.match(await entered(page, '.watch $:c+0'), /^\$:c\+0 = [^\n]*\n$/);
        assert.match(await entered(page, '.step'), /^@[^\n]*\n\$:c\+0 = [^\n]*\n$/);
        assert.match(await entered(page, 'help sin'), /^sin\(/);
    },
}));

test('the prompt says which commands work elsewhere, and reports an error once', options, () => opened('', {
    use: async page => {
        assert.match(await entered(page, '.save here'), /^\.save works only in 'petri repl'; in the page, use Export or Copy link\n$/);
        assert.match(await entered(page, '.quit'), /^\.quit works only in 'petri repl'/);
        assert.match(await entered(page, '.stp'), /^no such command: '\.stp'; did you mean '\.step'\?\n$/);
        assert.match(await entered(page, '.goto'), /^\.goto needs the number of a frame\n$/);
        assert.match(await entered(page, '.step 0'), /^not an integer >= 1: '0'\n$/);
        assert.equal((await entered(page, '.until coss(1) --limit 2')).match(/unbound name/g).length, 1);
        const error = await entered(page, '1 +');
        assert.match(error, /^prompt:1:\d+: error: /);
        assert.equal(error.match(/prompt:/g).length, 1);
        await entered(page, '.5 + 1'); // a number, not a command
        assert.match(await prompted(page), /\n1\.5\n$/);
        await page.fill('#line', '.plot frame*10');
        await page.press('#line', 'Enter');
        await page.waitForFunction(() => /^frame\*10 = /.test(document.getElementById('plot-summary').textContent));
    },
}));

test('watched expressions are plotted, including earlier frames', options, () => opened('', {
    use: async page => {
        await running(page, NOW);
        await seek(page, 3);
        await page.click('#tab-plot');
        const said = wanted => page.waitForFunction(text => document.getElementById('plot-summary').textContent === text, wanted);
        await page.fill('#watch-line', 'round(frame*10)');
        await page.press('#watch-line', 'Enter');
        await said('round(frame*10) = 30 in frame 3');
        await page.click('#back');
        await said('round(frame*10) = 20 in frame 2');
        const inked = () => page.evaluate(() => {
            const canvas = document.getElementById('plot-picture');
            const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
            let blue = 0;
            for (let i = 0; i < data.length; i += 4)
                blue += data[i + 2] > data[i] + 100 && data[i + 3] > 100;
            return blue;
        });
        assert.ok(await inked() > 100, `${await inked()}`);
        await page.fill('#watch-line', "'word'");
        await page.press('#watch-line', 'Enter');
        await said("round(frame*10) = 20 in frame 2, 'word' is not a number: 'word'");
        await page.click('#watched li:nth-child(2) button');
        await page.click('#watched li:nth-child(1) button');
        await said('');
        assert.equal(await page.textContent('#problems'), '');
    },
}));

test('a state of 100000 keys is filtered and sorted', options, () => opened('', {
    use: async page => {
        await running(page, '!physics state=:p dimensions=2 time=time\n    for i in ..50000\n'
            + '        !particle id=i position=i;(0-i)\n!window size=8;8\n    !canvas\n');
        await page.click('#tab-state');
        const count = wanted => page.waitForFunction(pattern =>
            new RegExp(pattern).test(document.getElementById('state-count').textContent), wanted);
        await count('^1 to 100 of 10000\\d$');
        assert.equal(await page.locator('#state-rows tr').count(), 100);
        const begun = Date.now();
        await page.fill('#state-filter', ':p;4999');
        await count('^1 to 22 of 22 \\(10000\\d without the filter\\)$');
        await page.click('#panel-state th:first-child button');
        await page.waitForFunction(() => document.querySelector('#state-rows th').textContent === ':p;4999');
        await page.click('#panel-state th:first-child button');
        await page.waitForFunction(() => document.querySelector('#state-rows th').textContent === ':p;49999;:velocity');
        assert.equal(await page.getAttribute('#panel-state th:first-child', 'aria-sort'), 'descending');
        assert.match(await page.textContent('#state-rows tr:nth-child(2) td'), /^49999; -49999$/);
        assert.match(await page.textContent('#state-digest'), /^digest [0-9a-f]{32}$/);
        await page.fill('#state-filter', '');
        await page.click('#state-after');
        await count('^101 to 200 of 10000\\d$');
        assert.ok(Date.now() - begun < 20000);
    },
}));

test('completion and help use petri\'s tables', options, () => opened('', {
    use: async page => {
        await typed(page, 'let SPEEDY=3\n!physics state=:p\n    !particle radi');
        await page.waitForSelector('.cm-tooltip-autocomplete');
        const first = page.locator('.cm-tooltip-autocomplete li').first();
        assert.match(await first.textContent(), /^radius/);
        await page.waitForTimeout(100); // initially, the list ignores keys
        await page.keyboard.press('Enter');
        assert.match(await page.textContent('.cm-content'), /!particle radius=$/);
        await page.keyboard.insertText('SPE');
        await page.keyboard.press('Control+Space');
        await page.waitForFunction(() => /SPEEDY/.test(document.querySelector('.cm-tooltip-autocomplete')?.textContent));
        await page.keyboard.press('Escape');
        await page.hover('.cm-line:nth-child(3) >> text=!particle');
        await page.waitForFunction(() => /^!particle ./.test(document.querySelector('.cm-help')?.textContent));
        // There is no help for words in comments and strings.
        await typed(page, '-- radius\nlet TEXT="radius"\n!physics state=:p\n    !particle radius=1');
        for (const line of [1, 2]) {
            await page.hover(`.cm-line:nth-child(${line}) >> text=radius`);
            await page.waitForTimeout(600); // more than the delay of help
            assert.equal(await page.locator('.cm-help').count(), 0);
        }
    },
}));

test('on a phone, the picture is first, nothing is cut off, and buttons are large enough', options, () => opened('', {
    settings: { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true },
    use: async page => {
        const box = selector => page.locator(selector).boundingBox();
        const [picture, run, text] = [await box('#picture'), await box('#run'), await box('#editor')];
        assert.ok(picture.y < run.y && run.y < text.y);
        assert.ok(run.y + run.height < 740 && run.height >= 30, JSON.stringify(run));
        assert.ok(picture.width > 200);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 360);
        for (const tab of ['#tab-plot', '#tab-state', '#tab-prompt'])
            await page.tap(tab);
        await page.tap('#step');
        await atFrame(page, 3);
        await page.tap('#save-as');
        const dialog = await box('#saving');
        assert.ok(dialog.x >= 0 && dialog.x + dialog.width <= 360, JSON.stringify(dialog));
    },
}));

test('everything can be done with the keyboard', options, () => opened('', {
    use: async page => {
        const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.className);
        const tabTo = async (id, max = 40) => {
            for (let i = 0; i < max && await focused() !== id; i++)
                await page.keyboard.press('Tab');
            assert.equal(await focused(), id);
        };
        await tabTo('save-as');
        await page.keyboard.press('Enter');
        await page.waitForSelector('#saving', { state: 'visible' });
        await page.keyboard.press('Escape');
        await page.waitForSelector('#saving', { state: 'hidden' });
        assert.equal(await focused(), 'save-as');
        await tabTo('hint-close');
        await page.keyboard.press('Tab');
        assert.match(await focused(), /cm-content/);
        await page.keyboard.press('Escape'); // so that Tab moves the focus out of the text
        await tabTo('picture');
        await tabTo('step');
        await page.keyboard.press('Enter');
        await atFrame(page, 3);
        await tabTo('time');
        await page.keyboard.press('ArrowLeft');
        await atFrame(page, 2);
        await tabTo('tab-prompt');
        await page.keyboard.press('ArrowRight');
        assert.equal(await focused(), 'tab-plot');
        await tabTo('watch-line');
    },
}));

test('pointer and keys are passed to the script while the picture has the focus', options, () => opened('', {
    use: async page => {
        const keys = { Enter: 'enter', a: 'a', PageUp: 'page_up', F2: 'f2', Shift: 'left_shift', ';': 'semicolon', ArrowLeft: 'left' };
        const nodes = Object.values(keys).map(name => `    !key name=:${name} state=:${name}\n`).join('');
        await typed(page, `!window size=200;100\n    !pointer state=:at\n${nodes}    !canvas\n        !rect size=200;100 fill=true\n`);
        await page.keyboard.press('Control+Enter');
        await page.waitForFunction(() => document.getElementById('picture').width === 200);
        const shows = async (expression, value) => { // in the next frame, without changing pointer or focus
            await page.evaluate(() => document.getElementById('step').click());
            await page.evaluate(text => {
                document.getElementById('line').value = text;
                document.getElementById('line').form.requestSubmit();
            }, expression);
            await page.waitForFunction(end =>
                document.getElementById('printed').textContent.trimEnd().endsWith(end), `${expression}\n${value}`);
        };
        await page.focus('#picture');
        for (const [key, name] of Object.entries(keys)) {
            await page.keyboard.down(key);
            await shows(`$(:${name})`, '1');
            await page.keyboard.up(key);
            await shows(`$(:${name})`, '0');
        }
        await page.keyboard.down('a');
        await shows('$(:a)', '1');
        await page.focus('#line'); // the key is released while the picture does not have the focus
        await page.keyboard.up('a');
        await shows('$(:a)', '0');
        const { x, y, width, height } = await page.locator('#picture').boundingBox();
        await page.mouse.move(x + width / 4, y + height / 2);
        await shows('round(100*$(:at))', '25;50');
        await page.mouse.move(1, 1);
        await shows('$(:at)', 'null');
    },
}));

// Clicks a point of the picture, given in its units, and returns what the panel shows.
async function clicked(page, x, y, title) {
    await page.evaluate(([px, py]) => {
        const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
        canvas.dispatchEvent(new MouseEvent('click', {
            clientX: box.left + px / canvas.width * box.width, clientY: box.top + py / canvas.height * box.height,
        }));
    }, [x, y]);
    await page.waitForFunction(wanted => document.getElementById('particle-title').textContent.startsWith(wanted), title);
    return page.evaluate(() => ({
        state: document.getElementById('particle-state').textContent,
        rows: [...document.querySelectorAll('#particle-forces tr')].map(row => [...row.children].map(cell => cell.textContent)),
    }));
}

const PULLED = `!physics state=:p dimensions=2 time=time
    for i in ..3
        !particle id=i*10 position=100+100*i;100 velocity=0
    !gravity strength=10
    !constant force=0;1
`;

test('a click on a particle that the script draws shows the forces on it', options, () => opened('', {
    use: async page => {
        await running(page, `${PULLED}!window size=800;600
    !canvas
        !transform translate=50;20 scale=2
            for i in ..3
                !transform translate=$(:p;i*10)
                    !ellipse radius=20 fill=true color=1
`);
        await seek(page, 5);
        const { state, rows } = await clicked(page, 450, 220, ':p;10 in frame 5: 3 contributions');
        assert.match(state, /^\$\(:p;10\) = 200;100\.\d+\n\$\(:p;10;:velocity\) = /);
        assert.deepEqual(rows.map(([kind, from, , line]) => [kind, from, line]),
            [['gravity', '0', 'dish.fl:4'], ['gravity', '20', 'dish.fl:4'], ['constant', '', 'dish.fl:5'], ['sum', '', '']]);
        const vectors = rows.map(row => row[2].split(';').map(Number));
        assert.deepEqual([0, 1].map(k => vectors[0][k] + vectors[1][k] + vectors[2][k]), vectors[3]);
        assert.equal(await page.textContent('#particle-origin'), 'made by line 3');
        await page.click('#particle-origin button');
        assert.match(await page.textContent('.cm-activeLine'), /!particle id=i\*10/);
        await page.click('#particle-forces tr:nth-child(3) button');
        assert.ok(await page.evaluate(() => document.activeElement.classList.contains('cm-content')));
        await page.click('#step'); // the panel follows the particle
        await page.waitForFunction(() => document.getElementById('particle-title').textContent.startsWith(':p;10 in frame 6'));
        await clicked(page, 20, 500, ':p;10 in frame 6'); // there is no particle
    },
}));

test('a click on a particle of the automatic picture shows the forces on it', options, () => opened('', {
    use: async page => {
        await running(page, PULLED);
        await seek(page, 4);
        const [x, y] = await page.evaluate(() => { // the disc at the left
            const canvas = document.getElementById('picture'), context = canvas.getContext('2d');
            const { data, width, height } = context.getImageData(0, 0, canvas.width, canvas.height);
            for (let i = 0; i < width; i++)
                for (let k = 0; k < height; k++)
                    if (data[4 * (k * width + i) + 2] > 150)
                        return [i + 2, k];
            return null;
        });
        const { rows } = await clicked(page, x, y, ':p;0 in frame 4');
        assert.equal(rows.length, 4);
    },
}));

const frames = async page => (await prompted(page)).match(/^> \d+$/gm)?.map(line => Number(line.slice(2))) ?? [];
const upTo = last => Array.from({ length: last + 1 }, (_, i) => i);

test('the prompt shows the output of each frame once', options, () => opened('', {
    use: async page => {
        await typed(page, 'let SIZE=SIZE or 3 -- 1..9\ndebug(frame)\n!window size=8;8\n    !canvas\n');
        await page.evaluate(() => delete document.body.dataset.frame);
        await page.evaluate(() => (document.getElementById('printed').textContent = ''));
        await page.click('#reset');
        await page.waitForFunction(() => document.body.dataset.frame === '0');
        await page.evaluate(() => {
            document.getElementById('speed').value = '4'; // several frames per picture
            document.getElementById('speed').dispatchEvent(new Event('change'));
        });
        await page.click('#run');
        await page.waitForFunction(() => Number(document.body.dataset.frame) > 60);
        await page.click('#run');
        const end = await page.waitForFunction(() => document.getElementById('run').textContent === 'Run' && document.body.dataset.frame);
        const last = Number(await end.jsonValue());
        assert.deepEqual(await frames(page), upTo(last));
        await seek(page, 30); // of frames that are computed again, only that of the one that is shown
        assert.deepEqual(await frames(page), [...upTo(last), 30]);
        await page.locator('#parameters input[type=range]').focus();
        await page.keyboard.press('ArrowRight'); // no frame is computed; later frames are new
        await page.waitForFunction(() => document.getElementById('time').max === '30');
        await page.click('#step');
        await atFrame(page, 31);
        assert.deepEqual(await frames(page), [...upTo(last), 30, 31]);
    },
}));

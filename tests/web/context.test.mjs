// context.test.mjs: loss and restoration of the WebGL context, with the extension WEBGL_lose_context.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { atFrame, opened, options, pixels, typed } from './browser.mjs';

const MESSAGE = /^The WebGL context was lost; .* these nodes are not drawn: (.*)\.$/;
const LOSSES = 3; // after more losses, the page does not let the browser restore the context
const SQUARE = '!canvas\n            !rect point=4;4 size=20;10 color=1;0.5;0 fill=true\n';
const EFFECTS = `!window size=64;32
    !bloom radius=2
        ${SQUARE}    !shader fragment='''
\${HEADER}
in vec2 coord;
uniform float frame;
out vec4 color;
void main() {
    color = vec4(coord.x, 0.0, frame / 10.0, 1.0);
}
'''
    !canvas3d
        !light color=1 direction=0;0;-1
        !sphere position=0;0;0 size=0.2
`;
const FEEDBACK = '!window size=64;32\n    !feedback mixer=0.9 translate=3;1\n'
    + '        !canvas\n            !rect size=9;9 point=(5*frame);2 color=1 fill=true\n';
const SCENE = '!physics state=:world dimensions=2\n    !particle id=0 radius=9 position=0;0 velocity=90;0\n'
    + '!window size=64;32\n    !canvas3d\n        !light color=1 direction=0;0;-1\n        !sphere position=0;0;0 size=0.2\n';

const message = page => page.textContent('#message');
const said = (page, pattern) => page.waitForFunction(source =>
    new RegExp(source).test(document.getElementById('message').textContent), pattern.source);
const inWorker = (page, act) => page.workers()[0].evaluate(name => globalThis.loss[name](), act);
const lose = page => inWorker(page, 'loseContext');
const restore = page => inWorker(page, 'restoreContext');

// Opens the page with a worker whose WebGL context can be lost. The browser logs a warning for each loss.
const withLoss = use => opened('', {
    expected: /willReadFrequently|CONTEXT_LOST_WEBGL|GPU stall|restoreContext/,
    prepare: page => page.route('**/worker.js*', async route => {
        const response = await route.fetch();
        await route.fulfill({ response, body: `OffscreenCanvas.prototype.getContext = (get => function (kind, ...more) {
            const context = get.call(this, kind, ...more);
            if (kind === 'webgl2')
                globalThis.loss = context.getExtension('WEBGL_lose_context');
            return context;
        })(OffscreenCanvas.prototype.getContext);
        ${await response.text()}` });
    }),
    use,
});

async function loaded(page, script, frames) {
    await typed(page, script);
    await page.waitForFunction(() => document.getElementById('picture').width === 64);
    await page.click('#reset');
    await atFrame(page, 0);
    for (let frame = 0; frame < frames; frame++) {
        await page.click('#step');
        await atFrame(page, frame + 1);
    }
    assert.equal(await page.textContent('#problems'), '');
}

// Waits until the sum of the picture's pixels is, or is no longer, `sum`.
async function pictureIs(page, sum, equal = true) {
    for (let i = 0; i < 200 && ((await pixels(page)).sum === sum) !== equal; i++)
        await page.waitForTimeout(25);
    assert.equal((await pixels(page)).sum === sum, equal);
}

for (const [what, script, frames, nodes] of [['effects, shaders and scenes', EFFECTS, 3, ['bloom', 'shader', 'canvas3d']],
    ['pictures of earlier frames', FEEDBACK, 9, ['feedback']]])
    test(`a lost WebGL context is reported, and after it is restored the picture is as before: ${what}`, options,
        () => withLoss(async page => {
            await loaded(page, script, frames);
            const { sum } = await pixels(page);
            for (let i = 0; i < 2; i++) {
                await lose(page);
                await said(page, MESSAGE);
                const missing = (await message(page)).match(MESSAGE)[1].split(', ');
                nodes.forEach(node => assert.ok(missing.includes(node), `${missing}`));
                assert.ok(await page.evaluate(() => document.getElementById('message').classList.contains('error')));
                await pictureIs(page, sum, false);
                await restore(page);
                await page.waitForFunction(() => document.getElementById('message').textContent === '');
                await pictureIs(page, sum);
            }
        }));

test('while the WebGL context is lost, 2D drawing continues and a scene shows its particles', options, () => withLoss(async page => {
    await loaded(page, SCENE, 3);
    const { sum } = await pixels(page);
    await lose(page);
    await said(page, MESSAGE);
    await page.click('#step');
    await atFrame(page, 4);
    assert.match(await message(page), MESSAGE);
    assert.ok((await pixels(page)).all > 3);
    await typed(page, `!window size=64;32\n    ${SQUARE}`);
    await page.click('#reset');
    await page.waitForFunction(() => document.getElementById('message').textContent === '');
    const at = await page.evaluate(() => [...document.getElementById('picture').getContext('2d').getImageData(10, 10, 1, 1).data]);
    assert.deepEqual(at, [255, 128, 0, 255]);
    await loaded(page, SCENE, 3);
    await said(page, MESSAGE);
    await restore(page);
    await page.waitForFunction(() => document.getElementById('message').textContent === '');
    await pictureIs(page, sum);
}));

test('a running script continues through a loss of the WebGL context', options, () => withLoss(async page => {
    await loaded(page, EFFECTS, 3);
    await page.click('#run');
    await page.waitForFunction(() => document.body.dataset.frame > 5);
    await lose(page);
    await said(page, MESSAGE);
    const lost = await page.evaluate(() => Number(document.body.dataset.frame));
    await page.waitForFunction(frame => document.body.dataset.frame > frame + 5, lost);
    await restore(page);
    await page.waitForFunction(() => document.getElementById('message').textContent === '');
    const restored = await page.evaluate(() => Number(document.body.dataset.frame));
    await page.waitForFunction(frame => document.body.dataset.frame > frame + 5, restored);
    assert.equal(await message(page), '');
    assert.equal(await page.textContent('#problems'), '');
}));

test('after too many losses the WebGL context is not restored, and the message stays', options, () => withLoss(async page => {
    await loaded(page, EFFECTS, 3);
    const { sum } = await pixels(page);
    for (let i = 0; i < LOSSES; i++) {
        await lose(page);
        await said(page, MESSAGE);
        await restore(page);
        await pictureIs(page, sum);
    }
    await lose(page);
    await said(page, MESSAGE);
    await restore(page);
    await page.waitForTimeout(300);
    assert.match(await message(page), MESSAGE);
    await page.click('#step');
    await atFrame(page, 4);
    assert.match(await message(page), MESSAGE);
}));

// dish.test.mjs: speed and position of a dish, with a simulated clock and engine, so that the test does not depend on real time.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Dish } from '../../src/web/page/dish.mjs';

const TICK = 15.625; // 1/64 s in ms, so that all sums are exact

// Returns a simulated world with a dish. Its display ticks when the test calls tick(). Its engine answers at once or, while
// `holds` is true, collects its answers in `held`.
function made() {
    const world = { now: 0, waiting: [], asked: [], held: [], holds: false, frame: -1, cost: 0 };
    const globals = { requestAnimationFrame: callback => world.waiting.push(callback), performance: { now: () => world.now } };
    const before = Object.fromEntries(Object.keys(globals).map(name => [name, Object.getOwnPropertyDescriptor(globalThis, name)]));
    for (const [name, value] of Object.entries(globals))
        Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
    world.restore = () => Object.entries(before).forEach(([name, how]) =>
        how ? Object.defineProperty(globalThis, name, how) : delete globalThis[name]);
    const worker = {
        broken: new Promise(() => {}),
        postMessage({ act, id, count, frame }) {
            world.now += act === 'step' ? count * world.cost : 0;
            world.frame = act === 'load' ? 0 : act === 'step' ? world.frame + count : act === 'seek' ? frame : world.frame;
            world.asked.push(act === 'step' ? count : act === 'seek' ? `to ${frame}` : act);
            const data = { type: 'frame', id, frame: world.frame, lastFrame: world.frame, fps: 60, parameters: [], reported: [] };
            const answer = () => worker.onmessage({ data });
            world.holds ? world.held.push(answer) : queueMicrotask(answer);
        },
    };
    const host = { shown() {}, failed(error) { throw error; }, changed() {} };
    world.dish = new Dish(null, host, { source: 'engine.wasm', worker });
    return world;
}

// Waits until all promises that depend on no pending request are settled.
const settled = () => new Promise(resolve => setImmediate(resolve));

async function tick(world, ms = TICK) {
    world.now += ms;
    world.waiting.splice(0).forEach(callback => callback(world.now));
    await settled();
}

async function running(t) {
    const world = made();
    t.after(world.restore);
    await world.dish.load('!a\n', 'a.fl');
    world.dish.run();
    world.asked.length = 0;
    return world;
}

test('the speed determines the frames per second, whatever the display rate', async t => {
    const world = await running(t), { dish } = world;
    for (const [speed, ticks, ms] of [[1, 64, TICK], [0.25, 64, TICK], [0.5, 64, TICK], [2, 64, TICK], [4, 64, TICK], [1, 16, 4 * TICK]]) {
        dish.speed = speed;
        const before = dish.frame;
        for (let i = 0; i < ticks; i++)
            await tick(world, ms);
        assert.equal(dish.frame - before, 60 * speed, `at ${speed}`);
    }
});

test('a slow script falls behind and does not catch up', async t => {
    const world = await running(t), { dish } = world;
    await tick(world, 5000);
    assert.deepEqual(world.asked, [8]);
    await tick(world);
    assert.equal(dish.frame, 8);
    await tick(world);
    assert.equal(dish.frame, 9);
});

test('a slow script has a picture for every frame, and the rate is measured', async t => {
    const world = await running(t), { dish } = world, rates = [];
    dish.host.ran = rate => rates.push(rate);
    world.cost = 200;
    for (let i = 0; i < 12; i++)
        await tick(world);
    assert.ok(world.asked.every(count => count === 1), `${world.asked}`);
    assert.ok(Math.abs(rates.at(-1) - 1000 / (200 + TICK)) < 0.5, `${rates}`);
    world.cost = 0;
    for (let i = 0; i < 192; i++)
        await tick(world);
    assert.equal(Math.round(rates.at(-1)), 60);
});

test('pausing and resuming while a frame is computed does not run twice', async t => {
    const world = await running(t), { dish } = world;
    // Returns the number of requests that two ticks cause. The second tick comes before a request of the first is answered.
    const heldTicks = async () => {
        world.holds = true;
        world.asked.length = 0;
        await tick(world, 4 * TICK);
        await tick(world, 4 * TICK);
        return world.asked.length;
    };
    const answered = async () => {
        world.holds = false;
        world.held.splice(0).forEach(answer => answer());
        await settled();
    };
    assert.equal(await heldTicks(), 1);
    dish.pause();
    dish.run();
    await answered();
    await tick(world);
    assert.equal(await heldTicks(), 1);
    await answered();
});

test('while the timeline is dragged, only the last position is requested', async t => {
    const world = await running(t), { dish } = world;
    world.holds = true;
    for (const frame of [5, 9, 30, 12])
        dish.seek(frame);
    while (dish.wanted !== null) {
        await settled();
        world.held.splice(0).forEach(answer => answer());
    }
    assert.deepEqual(world.asked, ['to 5', 'to 12']);
    assert.equal(dish.frame, 12);
    assert.equal(dish.running, false);
});

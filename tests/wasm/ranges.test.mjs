// SPDX-License-Identifier: Zlib
//
// Every number from JavaScript has a range: its ends are taken, what lies beyond is refused in one sentence and changes nothing.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { builds, CairnError, rock, steps } from './package.mjs';

const cairn = builds.vectors;
const tree = cairn.readTree(rock, 'rock.cairn');
const shape = cairn.makeShape(tree);

const [along, level] = [(x) => [0, x, 0], [0, 1, 0]];

/// What takes a number: least and greatest, as index.d.ts has them, and the call. The world has a body 0.
const kTaken = {
  'makeWorld: gravity': [-1e4, 1e4, (x) => cairn.makeWorld({ gravity: along(x) }).free()],
  'makeWorld: the time step': [1e-5, 1, (timeStep) => cairn.makeWorld({ timeStep }).free()],
  'makeShape: the scale': [1e-3, 1e4, (scale) => cairn.makeShape(tree, { scale }).free(), [1e-7, 1e7]],
  'makeShape: the maxContactError': [0, 1, (maxContactError) => cairn.makeShape(tree, { maxContactError }).free()],
  'cut: the number of levels': [1, 255, (depth) => tree.cut(depth).free()],
  'spheres: the level': [0, 255, (x) => tree.spheres(x)],
  'setGravity: gravity': [-1e4, 1e4, (x, world) => world.setGravity(along(x))],
  'setIterations: the number of iterations': [1, 1000, (x, world) => world.setIterations(x)],
  'setBudget: the number of operations': [0, 9e15, (operations, world) => world.setBudget({ operations })],
  'setBudget: the number of microseconds': [0, 1e9, (microseconds, world) => world.setBudget({ microseconds })],
  'addPlane: the normal': [-1000, 1000, (x, world) => world.addPlane(along(x), -900)],
  "addPlane: the normal's length": [1e-3, 1000, (x, world) => world.addPlane(along(x), -900), [1e-4]],
  'addPlane: the offset': [-1e6, 1e6, (offset, world) => world.addPlane([0, -1, 0], offset)],
  "addPlane: the offset over the normal's length": [-1e6, 1e6, (x, world) => world.addPlane([0, 0, -0.5], typeof x === 'number' ? 0.5 * x : x)],
  'addPlane: the friction': [0, 100, (friction, world) => world.addPlane(level, -900, { friction })],
  'addPlane: the restitution': [0, 1, (restitution, world) => world.addPlane(level, -900, { restitution })],
  'addBox: a half extent': [1e-4, 1e6, (x, world) => world.addBox([1, x, 1], { position: [9e5, 0, 0] })],
  'addBox: the position': [-1e6, 1e6, (x, world) => world.addBox([1, 1, 1], { position: along(x) })],
  'addBox: the friction': [0, 100, (friction, world) => world.addBox([1, 1, 1], { position: along(99), friction })],
  'addBody: the position': [-1e6, 1e6, (x, world) => world.addBody(shape, { position: along(x) })],
  'addBody: the mass': [1e-6, 1e9, (mass, world) => world.addBody(shape, { mass, position: along(9) })],
  'addBody: the friction': [0, 100, (friction, world) => world.addBody(shape, { friction, position: along(9) })],
  'addBody: the restitution': [0, 1, (restitution, world) => world.addBody(shape, { restitution, position: along(9) })],
  'setPose: the position': [-1e6, 1e6, (x, world) => world.setPose(0, along(x))],
  'setVelocity: the linear velocity': [-1e4, 1e4, (x, world) => world.setVelocity(0, along(x))],
  'setVelocity: the angular velocity': [-1e4, 1e4, (x, world) => world.setVelocity(0, level, along(x))],
  'drag: the point': [-1e6, 1e6, (x, world) => world.drag(0, along(x), level)],
  'drag: the target': [-1e6, 1e6, (x, world) => world.drag(0, level, along(x))],
};

function someWorld() {
  const world = cairn.makeWorld();
  world.addPlane(level, 0);
  world.addBody(shape, { position: [0, shape.size / 2, 0] });
  return world;
}

const isWhole = (what) => /number of levels|the level|iterations/.test(what);
const isLimit = (what) => /operations|microseconds/.test(what);

for (const [what, [least, most, call, beyond]] of Object.entries(kTaken))
  test(`${what}: from ${least} to ${most}`, () => {
    for (const end of [least, most]) {
      const world = someWorld();
      call(end, world);
      steps(world, 3);
      assert.ok([...world.transforms()].every(Number.isFinite), `a world goes on with ${end}`);
      world.free();
    }
    const world = someWorld();
    const before = world.stateHash();
    const outside = beyond ?? [least - (isWhole(what) ? 1 : Math.abs(least) / 1e3 + 1e-44), isWhole(what) ? most + 1 : most * 1.001, 1e38, ...(isWhole(what) ? [] : [NaN, 1e300, -1e300])];
    for (const number of outside.filter((x) => !isWhole(what) || x === (x | 0)))
      assert.throws(() => call(number, world), (e) => e instanceof CairnError && / is \S+; give \S.*[^.]$/.test(e.message) && e.message.startsWith(what.split(':')[0]), `${number}`);
    for (const other of ['5', [5], {}, true, 5n, ...(isLimit(what) ? [] : [null])])
      assert.throws(() => call(other, world), TypeError, String(other));
    assert.equal(world.stateHash(), before);
    assert.equal(world.asleep().length, 1);
    world.free();
  });

test('a mass that would be no number is refused with what, where and what to do', () => {
  const refusal = { name: 'CairnError', message: 'addBody: the mass is 1e-44; give kilograms from 0.000001 to 1e9, or 0 for a body that does not move' };
  assert.throws(() => someWorld().addBody(shape, { mass: 1e-44 }), refusal);
  assert.equal(someWorld().addBody(shape, { mass: 0 }), 1);
});

test('a shape of a size that floats do not bear is refused', () => {
  for (const scale of [1e-6, 1e6]) assert.throws(() => cairn.makeShape(tree, { scale }), /^CairnError: makeShape: the shape's size is \S+; give a scale that makes it/);
});

test('what is no object is no budget and no options', () => {
  const world = someWorld();
  for (const budget of [2000, '2000', [2000], undefined, { operation: 5 }, new Float32Array(2)])
    assert.throws(() => world.setBudget(budget), TypeError, String(budget));
  assert.throws(() => world.setBudget(2000), { message: 'setBudget: the budget is 2000; give an object such as { microseconds: 2000 }' });
  const calls = [() => cairn.makeWorld({ budget: 2000 }), () => cairn.makeWorld(1 / 60), () => cairn.makeShape(tree, 2), () => world.addBody(shape, [0, 1, 0]),
    () => world.addPlane(level, 0, 0.5), () => world.addBox([1, 1, 1], [0, 0, 0]), () => world.addBody(shape, null)];
  for (const call of calls) assert.throws(call, TypeError, String(call));
  assert.equal(steps(world, 1).statistics().deadlineMicroseconds, null);
});

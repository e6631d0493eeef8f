// SPDX-License-Identifier: Zlib
//
// Calls that a type checker would refuse: JavaScript makes them, and the module's memory stays whole.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { builds, CairnError, load, rock, steps } from './package.mjs';

const cairn = builds.vectors;
const tree = cairn.readTree(rock, 'rock.cairn');
const shape = cairn.makeShape(tree);

function refusesWithoutChange(calls) {
  const world = cairn.makeWorld();
  world.addBody(shape, { position: [0, 0, 5] });
  const before = world.stateHash();
  for (const call of calls) assert.throws(() => call(world), TypeError, String(call));
  assert.equal(world.stateHash(), before);
  assert.equal(world.asleep().length, 1);
}

test('NaN names no body', () => {
  const wrong = [NaN, undefined, null, 'rock', 0.5, 2 ** 32];
  refusesWithoutChange(wrong.map((body) => (world) => world.removeBody(body)));
  refusesWithoutChange(wrong.map((body) => (world) => world.setPose(body, [1, 1, 1])));
  refusesWithoutChange([(world) => world.release(NaN), (world) => world.setIterations(2 ** 32 + 1)]);
});

test('lists of too few or too many numbers are refused', () => {
  refusesWithoutChange([
    (world) => world.setGravity(new Float64Array(5000).fill(7)),
    (world) => world.setVelocity(0, [1, 2], [3, 4, 5]),
    (world) => world.setPose(0, [1, 2, 3], [0, 0, 0, 1, 0]),
    (world) => world.addPlane([0, 1], 0),
    (world) => world.addBox([1, 1, 1], { position: [1, 2] }),
    (world) => world.drag(0, [0, 0, 0], [1, 2, 3, 4]),
    (world) => world.addBody(shape, { position: [1, 2] }),
  ]);
});

test('things of another kind or another module are refused', async () => {
  const other = await load();
  const theirs = other.readTree(rock);
  const shapes = [{}, tree, 7, undefined, other.makeShape(theirs)];
  refusesWithoutChange(shapes.map((one) => (world) => world.addBody(one)));
  for (const one of [{}, shape, 7, undefined, theirs]) assert.throws(() => cairn.makeShape(one), TypeError);
  for (const bytes of [undefined, 'rock', rock.buffer, [1, 2]]) assert.throws(() => cairn.readTree(bytes), TypeError);
});

test('a world or a body that is refused half-way leaves nothing', () => {
  const world = cairn.makeWorld();
  assert.throws(() => world.addBody(shape, { linearVelocity: [NaN, 0, 0] }), CairnError);
  assert.ok(world.transforms().every(Number.isNaN));
  const before = cairn.memoryBytes();
  for (let i = 0; i < 40; ++i) assert.throws(() => cairn.makeWorld({ iterations: 0 }), CairnError);
  assert.ok(cairn.memoryBytes() - before < 40e6, 'not one of 40 worlds of some megabytes is held');
});

test('no negative amount is no limit', () => {
  const world = cairn.makeWorld();
  for (const amount of [-Infinity, -0.5]) {
    assert.throws(() => world.setBudget({ operations: amount }), CairnError);
    assert.throws(() => world.setBudget({ microseconds: amount }), CairnError);
  }
  world.setBudget({ operations: Infinity, microseconds: null });
  assert.equal(steps(world, 1).statistics().deadlineMicroseconds, null);
});

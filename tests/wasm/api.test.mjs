// SPDX-License-Identifier: Zlib
//
// What the package says of itself holds.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { builds, CairnError, CONTACT_STRIDE, described, load, rock, steps, worldOn } from './package.mjs';

const cairn = builds.vectors;
const tree = cairn.readTree(rock, 'rock.cairn');
const shape = cairn.makeShape(tree);
const errors = (of, level) => of.spheres(level).filter((_, i) => i % 5 === 4);
const worstLeaf = Math.max(...errors(tree, tree.depth));
const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const placeOf = (world, body) => world.transforms().slice(7 * body, 7 * body + 3);
const speeds = (world, body) => world.velocities().slice(6 * body, 6 * body + 6);

// Ground and four walls around the z axis, `room` sizes of a body apart.
function pit(module, room, options) {
  const world = worldOn(module, options);
  for (const normal of [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]) world.addPlane(normal, (-room / 2) * shape.size);
  return world;
}

function heap(options, module = cairn) {
  const world = pit(module, 3, options);
  const own = module === cairn ? shape : module.makeShape(module.readTree(rock));
  for (let i = 0; i < 30; ++i) world.addBody(own, { position: [(i % 3) / 2, (i % 2) / 2, own.size * (1 + i / 2)] });
  return world;
}

test('the package has the version of the library, and both builds', () => {
  assert.equal(described.version, cairn.version);
  assert.deepEqual([builds.vectors.simd, builds.plain.simd], [true, false]);
});

test('what is no tree is refused in one sentence, and the module goes on', () => {
  const damaged = Buffer.from(rock);
  damaged[damaged.length / 2] ^= 1;
  for (const bytes of [new Uint8Array(0), new Uint8Array(100), rock.subarray(0, 200), damaged])
    assert.throws(() => cairn.readTree(bytes, 'a.cairn'), (e) => e instanceof CairnError && /^a\.cairn \S.*\S$/.test(e.message));
  assert.equal(cairn.readTree(rock).nodes, tree.nodes);
});

test('what makes no sense is refused and changes nothing', () => {
  const world = worldOn(cairn);
  const body = world.addBody(shape, { position: [0, 0, 5] });
  const before = world.stateHash();
  const refused = [
    () => world.addBody(shape, { position: [NaN, 0, 0] }),
    () => world.addBody(shape, { rotation: [0, 0, 0, 2] }),
    () => world.addBody(shape, { mass: -1 }),
    () => world.addBody(shape, { friction: Infinity }),
    () => world.addBox([1, 0, 1]),
    () => world.addPlane([0, 0, 0], 1),
    () => world.removeBody(7),
    () => world.setPose(-1, [0, 0, 0]),
    () => world.setVelocity(body, [0, Infinity, 0]),
    () => world.drag(body, [0, 0, 0], [NaN, 0, 0]),
    () => world.setBudget({ operations: -1 }),
    () => world.setBudget({ microseconds: NaN }),
    () => world.setIterations(0),
    () => world.setGravity([0, 0, NaN]),
    () => cairn.makeWorld({ timeStep: 0 }),
    () => cairn.makeShape(tree, { scale: -1 }),
    () => cairn.makeShape(tree, { maxContactError: -1 }),
    () => tree.cut(0),
  ];
  for (const call of refused) assert.throws(call, CairnError, String(call));
  for (const call of [() => world.setUnresolved('never'), () => world.setFinest('atoms'), () => cairn.makeShape(tree, { frame: 'x' })])
    assert.throws(call, TypeError, String(call));
  assert.equal(world.stateHash(), before);
});

test('a body falls as the textbook says', () => {
  const world = cairn.makeWorld({ gravity: [0, 0, -10], timeStep: 1 / 100 });
  world.addBody(shape, { position: [1, 2, 3], linearVelocity: [4, 0, 0] });
  steps(world, 50);
  // Of semi-implicit steps: g dt^2 n (n + 1) / 2. Rounding of 50 sums of floats near 5: 50 * 2^-22.
  const [x, y, z] = placeOf(world, 0);
  for (const [is, should] of [[x, 1 + 4 * 0.5], [y, 2], [z, 3 - (10 * 1e-4 * 50 * 51) / 2]])
    assert.ok(Math.abs(is - should) < 2e-5, `${is}, not ${should}`);
});

test('contacts of a body at rest carry its weight upwards', () => {
  const world = worldOn(cairn);
  world.addBody(shape, { position: [0, 0, shape.size], mass: 3 });
  steps(world, 600);
  const list = world.contacts();
  assert.ok(list.length >= 3 * CONTACT_STRIDE && list.length % CONTACT_STRIDE === 0);
  let carried = 0;
  for (let i = 0; i < list.length; i += CONTACT_STRIDE) {
    const [, , height, , , normal, depth, error, a, b, impulse] = list.subarray(i, i + CONTACT_STRIDE);
    carried += impulse * normal * (a === 0 ? 1 : -1);
    assert.ok(Math.max(a, b) === 0 && Math.min(a, b) < 0, 'the body and the plane');
    assert.ok(Math.abs(height) < 1e-3 * shape.size && Math.abs(depth) < 0.01 * shape.size);
    assert.ok(error <= 2 * worstLeaf);
  }
  // Asleep: the impulses of its last step, which the solver leaves within some per cent of the weight.
  assert.ok(Math.abs(carried / (3 * 9.81 * world.timeStep) - 1) < 0.1, `${carried}`);
  assert.deepEqual([...world.asleep()], [1]);
});

const rowsOf = (world) => {
  const list = world.contacts();
  return Array.from({ length: list.length / CONTACT_STRIDE }, (_, i) => list.slice(i * CONTACT_STRIDE, (i + 1) * CONTACT_STRIDE));
};
const mean = (list) => list.reduce((sum, value) => sum + value, 0) / list.length;

test('contacts have the certified errors of their pairs, larger at leaves than between meshes', () => {
  const means = ['triangles', 'leaves'].map((finest) => {
    const world = steps(heap({ finest }), 100);
    const ofTwo = rowsOf(world).filter((row) => row[8] >= 0 && row[9] >= 0);
    assert.ok(ofTwo.length > 10);
    const greatest = Math.max(...ofTwo.map((row) => row[7])) / shape.size;
    assert.ok(greatest <= world.statistics().worstErrorFraction * (1 + 1e-6));
    return mean(ofTwo.map((row) => row[7]));
  });
  assert.ok(means[0] < means[1], `${means}`);
});

test('contacts say whether the budget sufficed for their pair', () => {
  assert.ok(rowsOf(steps(heap(), 100)).every((row) => row[11] === 1));
  const tight = rowsOf(steps(heap({ budget: { operations: 100 } }), 100)).map((row) => row[11]);
  assert.ok(tight.includes(0));
});

test('a budget of operations is kept and told', () => {
  const free = steps(heap(), 150).statistics();
  const tight = steps(heap({ budget: { operations: 100 } }), 150).statistics();
  assert.equal(free.unresolvedPairs, 0);
  assert.equal(free.deadlineMicroseconds, null);
  assert.ok(tight.unresolvedPairs > 0 && tight.worstErrorFraction > free.worstErrorFraction);
  assert.ok(tight.operations < free.operations / 2, `${tight.operations} of ${free.operations}`);
  assert.equal(steps(heap({ budget: { microseconds: 50 } }), 1).statistics().deadlineMicroseconds, 50);
});

test('policies of unfinished pairs differ', () => {
  const hashes = ['guard', 'repel', 'ignore', 'compensate'].map((unresolved) =>
    steps(heap({ budget: { operations: 200 }, unresolved }), 120).stateHash());
  assert.equal(new Set(hashes).size, 4);
});

test('the same calls give the same bits, in another world and another instance', async () => {
  const hash = steps(heap({ budget: { operations: 3000 } }), 200).stateHash();
  assert.equal(steps(heap({ budget: { operations: 3000 } }), 200).stateHash(), hash);
  const other = await load({ simd: false });
  assert.equal(steps(heap({ budget: { operations: 3000 } }, other), 200).stateHash(), hash);
});

test('a removed body leaves a hole, its neighbours wake, and its number is given again', () => {
  const world = pit(cairn, 1.1);
  world.addBox([1, 1, 0.25], { position: [0, 0, 0.25] });
  const [low, high] = [1, 2.1].map((z) => world.addBody(shape, { position: [0, 0, 0.5 + z * shape.size] }));
  steps(world, 900);
  assert.deepEqual([...world.asleep()], [1, 1]);
  world.removeBody(low);
  assert.ok([...placeOf(world, low)].every(Number.isNaN));
  assert.deepEqual([...world.asleep()], [2, 0]);
  const before = placeOf(world, high)[2];
  assert.ok(placeOf(steps(world, 60), high)[2] < before);
  assert.throws(() => world.removeBody(low), CairnError);
  assert.equal(world.addBody(shape, { position: [9, 9, 9] }), low);
});

test('a drag brings the held point to its target, and lets go', () => {
  const world = worldOn(cairn);
  const body = world.addBody(shape, { position: [0, 0, shape.size] });
  const target = [2, 1, 3];
  world.drag(body, tree.centerOfMass, target);
  steps(world, 300);
  // The target is the centre of mass, which the mesh's frame is that far from.
  assert.ok(far(placeOf(world, body), target) < Math.hypot(...tree.centerOfMass) + 0.02);
  world.drag(body, null);
  assert.ok(placeOf(steps(world, 60), body)[2] < 2);
});

test('a drag of a far target does not throw a body through the ground', () => {
  const world = worldOn(cairn);
  const body = world.addBody(shape, { position: [0, 0, shape.size] });
  steps(world, 60);
  world.drag(body, [0, 0, 0], [0, 0, -1000]);
  steps(world, 120);
  assert.ok(placeOf(world, body)[2] > 0);
});

test('poses are of the mesh, whatever frame a body turns about', () => {
  const pose = { position: [1, 2, 3], rotation: [0.6, 0, 0, 0.8] };
  for (const frame of ['principalAxes', 'mesh']) {
    const world = cairn.makeWorld({ gravity: [0, 0, 0] });
    world.addBody(cairn.makeShape(tree, { frame }), pose);
    [...pose.position, ...pose.rotation].forEach((should, i) => assert.ok(Math.abs(world.transforms()[i] - should) < 1e-6, frame));
    world.setPose(0, [4, 5, 6]);
    [4, 5, 6, 0, 0, 0, 1].forEach((should, i) => assert.ok(Math.abs(world.transforms()[i] - should) < 2e-6, frame));
    world.setVelocity(0, [1, 2, 3], [4, 5, 6]);
    assert.deepEqual([...speeds(world, 0)], [1, 2, 3, 4, 5, 6]);
  }
});

test('a tree that is cut has fewer spheres, larger errors and the same mesh', () => {
  const cut = tree.cut(1);
  assert.equal(cut.depth, 1);
  assert.ok(cut.nodes < tree.nodes);
  assert.deepEqual(cut.vertices(), tree.vertices());
  assert.deepEqual(cut.spheres(1), tree.spheres(1));
  assert.ok(Math.max(...errors(cut, 9)) > worstLeaf);
  assert.equal(steps(worldOn(cairn), 1).statistics().pairs, 0);
});

test('every vertex lies in a sphere of every level', () => {
  const vertices = tree.vertices();
  for (let level = 0; level <= tree.depth; ++level) {
    const spheres = tree.spheres(level);
    for (let v = 0; v < vertices.length; v += 3) {
      let inside = false;
      for (let s = 0; s < spheres.length && !inside; s += 5)
        inside = far(vertices.subarray(v, v + 3), spheres.subarray(s, s + 3)) <= spheres[s + 3] * (1 + 1e-6);
      assert.ok(inside, `vertex ${v / 3}, level ${level}`);
    }
  }
});

test('worlds come and go without holding memory', () => {
  const live = () => {
    const world = heap();
    steps(world, 60);
    world.free();
  };
  for (let i = 0; i < 5; ++i) live();
  const before = cairn.memoryBytes();
  for (let i = 0; i < 40; ++i) live();
  assert.equal(cairn.memoryBytes(), before);
});

test('what was freed is refused', () => {
  const world = cairn.makeWorld();
  world.free();
  assert.throws(() => world.step(), TypeError);
  const own = cairn.readTree(rock);
  own.free();
  assert.throws(() => own.vertices(), TypeError);
  assert.throws(() => cairn.makeShape(own), TypeError);
});

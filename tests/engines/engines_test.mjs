// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked of every engine and shape: the same mass, the same fall, rest, holes that are holes, and a hand that pulls.
//   node --test test/
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { makeBody } from '../../demos/engines/bodies.mjs';
import { decompose } from '../../demos/engines/hulls.mjs';
import * as havok from '../../demos/engines/havok.mjs';
import * as jolt from '../../demos/engines/jolt.mjs';
import * as rapier from '../../demos/engines/rapier.mjs';

const kGravity = [0, -9.81, 0];
const kTimeStep = 1 / 60;
const kUpright = [0, 0, 0, 1];
const kLying = [Math.SQRT1_2, 0, 0, Math.SQRT1_2]; // z of the body upward
const kTwentyDegrees = [Math.sin(Math.PI / 18), 0, 0, Math.cos(Math.PI / 18)];

const ring = makeBody('ring');
ring.hulls = await decompose(ring, { voxelResolution: 50000 });
const kTube = 0.3 / Math.hypot(2.6, 2.6, 0.6); // radius of the ring's tube, from its formula

const cases = [
  ...['mesh', 'decomposition', 'hulls'].flatMap((shape) => [true, false].map((simd) => [rapier, shape, { simd }])),
  [jolt, 'hulls'],
  ...['mesh', 'hulls'].map((shape) => [havok, shape]),
];

function placeOf(world, index) {
  const [x, y, z, qx, qy, qz, qw] = world.transforms().subarray(7 * index, 7 * index + 7);
  return { x, y, z, rotation: [qx, qy, qz, qw] };
}

for (const [module, kind, options] of cases) {
  const engine = await module.load({ shape: kind, ...options });
  const shape = engine.prepare(ring);
  const worldOf = (gravity = kGravity) => engine.createWorld({ gravity, timeStep: kTimeStep, seed: 1 });
  const grounded = () => {
    const world = worldOf();
    world.addBox([5, 0.5, 5], [0, -0.5, 0], kUpright);
    return world;
  };
  const name = `${engine.name} ${engine.version}, ${kind}`;

  test(`${name}: falls as bodies do`, () => {
    const world = worldOf();
    world.addBody(shape, { position: [0, 0, 0], rotation: kUpright, linearVelocity: [3, 0, 0] });
    for (let step = 0; step < 30; ++step) world.step();
    const { x, y } = placeOf(world, 0);
    // Half a second: 1.226 m by the formula; one step more or less is 0.08 m, and Havok damps by a little.
    assert.ok(Math.abs(y + (9.81 * 0.5 ** 2) / 2) < 0.09, `fell to ${y}`);
    assert.ok(Math.abs(x - 1.5) < 0.05, `flew to ${x}`);
    assert.ok(world.times().stepMs > 0);
    world.free();
  });

  test(`${name}: comes to rest on its side, a tube's radius above the ground, and sleeps`, () => {
    const world = grounded();
    world.addBody(shape, { position: [0, 0.4, 0], rotation: kLying });
    let steps = 0;
    while (world.asleep() < 1 && steps < 600) steps += (world.step(), 1);
    const { y } = placeOf(world, 0);
    assert.ok(Math.abs(y - kTube) < 0.02, `rests at ${y}, radius ${kTube}`);
    assert.equal(world.asleep(), 1, 'asleep within ten seconds');
    world.free();
  });

  test(`${name}: a ring falls over a post, as its hole is a hole`, () => {
    const world = grounded();
    world.addBox([0.06, 0.4, 0.06], [0, 0.4, 0], kUpright);
    world.addBody(shape, { position: [0.02, 1.1, 0], rotation: kLying });
    for (let step = 0; step < 240; ++step) world.step();
    const { x, y, z } = placeOf(world, 0);
    assert.ok(y < 0.2 && Math.hypot(x, z) < 0.35, `lies at ${[x, y, z]}`);
    world.free();
  });

  test(`${name}: turns about the same axes as the solid does`, () => {
    // A pull beside the centre turns a free body; mass and inertia say how far. Two rotations agree, as frames must not matter.
    const turned = [kUpright, kTwentyDegrees].map((rotation) => {
      const world = worldOf([0, 0, 0]);
      world.addBody(shape, { position: [0, 0, 0], rotation });
      world.drag(0, [0.3, 0, 0], [0.3, 0.2, 0]);
      for (let step = 0; step < 20; ++step) world.step();
      const place = placeOf(world, 0);
      world.free();
      return place;
    });
    assert.ok(turned[0].y > 0.02 && turned[0].rotation[2] > 0.02, 'pulled up, and turned about z');
    assert.ok(Math.abs(turned[0].y - turned[1].y) < 0.02, `${turned[0].y} and ${turned[1].y}`);
  });

  test(`${name}: a hand lifts a body that sleeps, holds it and lets go`, () => {
    const world = grounded();
    world.addBody(shape, { position: [0, kTube + 0.001, 0], rotation: kLying });
    for (let step = 0; step < 300; ++step) world.step();
    world.drag(0, [0, 0, 0], [0.5, 1, 0]);
    for (let step = 0; step < 180; ++step) world.step();
    const held = placeOf(world, 0);
    // The spring gives by g / stiffness = 0.11 m.
    assert.ok(Math.hypot(held.x - 0.5, held.y - 1 + 9.81 / 90, held.z) < 0.05, `held at ${[held.x, held.y, held.z]}`);
    world.drag(0, null);
    for (let step = 0; step < 180; ++step) world.step();
    assert.ok(placeOf(world, 0).y < 0.6, 'fell when let go');
    world.free();
  });

  test(`${name}: worlds of one engine do not know of each other`, () => {
    const run = (count) => {
      const worlds = Array.from({ length: count }, grounded);
      for (const world of worlds) world.addBody(shape, { position: [0, 0.5, 0], rotation: kTwentyDegrees });
      for (let step = 0; step < 60; ++step) for (const world of worlds) world.step();
      const poses = worlds.map((world) => [...world.transforms()]);
      worlds.forEach((world) => world.free());
      return poses;
    };
    const [alone] = run(1);
    for (const pose of run(3)) assert.deepEqual(pose, alone, 'the same input gives the same bits');
  });

  after(() => shape.free());
}

test('what cannot be is refused by name', async () => {
  await assert.rejects(rapier.load({ shape: 'balls' }), /no shape is named balls/);
  const engine = await jolt.load();
  assert.throws(() => engine.prepare(makeBody('hook')), /hook has no convex parts/);
  assert.throws(() => makeBody('swan'), /no body is named swan/);
});

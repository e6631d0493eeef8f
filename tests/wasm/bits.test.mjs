// SPDX-License-Identifier: Zlib
//
// The module gives the bits of the native library.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { builds, goldenHash, rock, round, square, steps, worldOn } from './package.mjs';

const walls = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]];

// As WalledHeap of tests/support/walled_heap.h, number by number.
function goldenHeap(cairn, budget) {
  const world = worldOn(cairn, { budget });
  for (const normal of walls) world.addPlane(normal, -1);
  const shapes = [square, round, round].map((bytes) => cairn.makeShape(cairn.readTree(bytes), { frame: 'mesh' }));
  // Additions are those of floats there.
  const f = Math.fround;
  for (let i = 0; i < 24; ++i) {
    const position = [(i % 2) - 0.5, f((Math.trunc(i / 2) % 2) - f(0.45)), f(f(0.4) + f(f(0.7) * Math.trunc(i / 4)))];
    world.addBody(shapes[i % 3], { position });
  }
  return world;
}

for (const [name, cairn] of Object.entries(builds)) {
  test(`${name}: a tree is written as it was read`, () => {
    for (const bytes of [rock, round, square]) assert.deepEqual(Buffer.from(cairn.readTree(bytes).bytes()), bytes);
  });

  test(`${name}: the golden heap ends as it does natively`, () => {
    assert.equal(steps(goldenHeap(cairn, { operations: 20000 }), 240).stateHash(), goldenHash);
  });

  test(`${name}: another budget ends otherwise`, () => {
    assert.notEqual(steps(goldenHeap(cairn, { operations: 2000 }), 240).stateHash(), goldenHash);
  });
}

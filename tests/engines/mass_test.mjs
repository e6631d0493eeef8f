// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mass properties against the formulas of a box and a torus.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { kBodies, makeBody } from '../../demos/engines/bodies.mjs';
import { massProperties, principalAxes } from '../../demos/engines/mass.mjs';
import { rotate } from '../../demos/engines/vectors.mjs';

const kCorners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1]);
const kFaces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]];
const near = (a, b, error = 1e-6) => assert.ok(Math.abs(a - b) <= error * Math.max(1, Math.abs(b)), `${a} is not ${b}`);

/// A box of size 1 x 2 x 3, turned and moved.
function box(rotation, place) {
  const points = kCorners.map(([x, y, z]) => rotate(rotation, [x - 0.5, 2 * y - 1, 3 * z - 1.5]).map((c, k) => c + place[k]));
  return { name: 'box', vertices: Float64Array.from(points.flat()), indices: Uint32Array.from(kFaces.flat()), mass: 12 };
}

test('a box far from its frame, turned', () => {
  const half = 0.4;
  const rotation = [Math.sin(half) / Math.sqrt(3), Math.sin(half) / Math.sqrt(3), Math.sin(half) / Math.sqrt(3), Math.cos(half)];
  const { center, volume, moments, axes, inertia } = massProperties(box(rotation, [5, -3, 2]));
  near(volume, 6);
  [5, -3, 2].forEach((c, k) => near(center[k], c));
  const expected = [4 + 9, 1 + 9, 1 + 4]; // mass / 12 times the squares of the other two sides
  [...moments].sort((a, b) => b - a).forEach((value, k) => near(value, expected[k]));
  // Axes and moments give the matrix again.
  [0, 1, 2].forEach((i) => {
    const axis = rotate(axes, [0, 1, 2].map((k) => (k === i ? 1 : 0)));
    const turned = inertia.map((row) => row.reduce((sum, part, k) => sum + part * axis[k], 0));
    turned.forEach((part, k) => near(part, moments[i] * axis[k], 1e-6));
  });
});

test('principal axes of a diagonal matrix are the frame', () => {
  const { values } = principalAxes([[3, 0, 0], [0, 2, 0], [0, 0, 1]]);
  assert.deepEqual(values, [3, 2, 1]);
});

test('a ring is a torus but for its facets', () => {
  const { moments, volume } = massProperties(makeBody('ring'));
  const unit = 1 / Math.hypot(2.6, 2.6, 0.6);
  const [big, small] = [unit, 0.3 * unit];
  near(volume, 2 * Math.PI ** 2 * big * small ** 2, 0.05);
  near(Math.max(...moments), big ** 2 + 0.75 * small ** 2, 0.03);
});

test('bodies are closed, a metre across, and have their centre of mass at the origin', () => {
  for (const name of kBodies) {
    const body = makeBody(name);
    const edges = new Map();
    for (let at = 0; at < body.indices.length; at += 3) {
      for (let k = 0; k < 3; ++k) {
        const edge = [body.indices[at + k], body.indices[at + ((k + 1) % 3)]];
        edges.set(edge.join(), (edges.get(edge.join()) ?? 0) + 1);
      }
    }
    for (const [edge, count] of edges) {
      assert.equal(count, 1, `${name}: edge ${edge} is there once in each direction`);
      assert.equal(edges.get(edge.split(',').reverse().join()), 1, `${name}: edge ${edge} has a neighbour`);
    }
    const { center } = massProperties(body);
    center.forEach((c) => near(c, 0, 1e-6));
    const spans = [0, 1, 2].map((c) => body.vertices.filter((_, at) => at % 3 === c)).map((list) => Math.max(...list) - Math.min(...list));
    near(Math.hypot(...spans), 1, 1e-6);
  }
});

test('a mesh turned inside out is refused', () => {
  const inside = box([0, 0, 0, 1], [0, 0, 0]);
  inside.indices.reverse();
  assert.throws(() => massProperties(inside), /box: the mesh encloses no volume/);
});

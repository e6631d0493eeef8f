// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where bodies start. All are about a metre across; a pit of boxes holds them. The same seed gives the same poses to every engine.
import { makeBody } from '../engines/bodies.mjs';
import { linkingNumber } from './linking.mjs';

const kUpright = [0, 0, 0, 1];
const kPitch = 1.05; // m between bodies that must not touch, whatever their rotation
const kWallThickness = 1; // m; half of it

/// Numbers from 0 to 1 by a 32-bit generator (mulberry32).
export function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/// A rotation, all alike probable (Shoemake).
function anyRotation(random) {
  const [u, a, b] = [random(), 2 * Math.PI * random(), 2 * Math.PI * random()];
  return [Math.sqrt(1 - u) * Math.sin(a), Math.sqrt(1 - u) * Math.cos(a), Math.sqrt(u) * Math.sin(b), Math.sqrt(u) * Math.cos(b)];
}

const about = (axis, angle) => [...axis.map((part) => part * Math.sin(angle / 2)), Math.cos(angle / 2)];

/// The quaternion that turns by `b`, then by `a`.
function after(a, b) {
  const [ax, ay, az, aw] = a;
  const [bx, by, bz, bw] = b;
  return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

export const halfWidthOf = (count) => 0.4 * Math.ceil(Math.cbrt(count));

/// Places for `count` things of a metre, layer by layer from `low` up, `height` a layer.
function columns(count, halfWidth, low, height) {
  const side = Math.max(1, Math.floor((2 * halfWidth) / kPitch));
  const at = (k) => (k - (side - 1) / 2) * kPitch;
  return Array.from({ length: count }, (_, i) => [at(i % side), low + height * Math.floor(i / (side * side)), at(Math.floor(i / side) % side)]);
}

const heap = (model) => ({
  model,
  start(count, random) {
    return columns(count, halfWidthOf(count), 0.6, kPitch).map((position) => ({ position, rotation: anyRotation(random) }));
  },
});

/// Groups of `size` bodies, each placed along the vertical from its own middle, `step` apart, turned as `turn` says.
const groups = (model, size, step, turn) => ({
  model,
  start(count, random) {
    const places = columns(Math.ceil(count / size), halfWidthOf(count), 0.6 + (step * size) / 2, step * size + 0.6);
    let heading = 0;
    return Array.from({ length: count }, (_, i) => {
      const [x, y, z] = places[Math.floor(i / size)];
      const k = i % size;
      if (k === 0) heading = 2 * Math.PI * random();
      const jitter = () => 0.01 * (random() - 0.5);
      return {
        position: [x + jitter(), y + step * (k - (size - 1) / 2), z + jitter()],
        rotation: after(about([0, 1, 0], heading), turn(k)),
      };
    });
  },
});

/// Metres of one unit of a body's formula: the ring reaches 1.3 units, the bowl 1.
const unitOf = (name, reach) => makeBody(name).vertices.reduce((most, value) => Math.max(most, value), 0) / reach;

/// A ring stands upright in a chain, every other one turned by a right angle. Centres are 1.3 units apart: the tubes, of 0.3
/// units' radius, have a tenth of a unit of room.
const kRing = unitOf('ring', 1.3);
const kLinks = 5;
const chains = {
  ...groups('ring', kLinks, 1.3 * kRing, (k) => about([0, 1, 0], (k % 2) * (Math.PI / 2))),
  /// Pairs that were linked at the start and are not any more: they went through each other.
  apart(poses) {
    const core = Array.from({ length: 36 }, (_, k) => [kRing * Math.cos((k * Math.PI) / 18), kRing * Math.sin((k * Math.PI) / 18), 0]);
    let count = 0;
    for (let i = 1; i < poses.length / 7; ++i) {
      const pair = [i - 1, i].map((body) => poses.slice(7 * body, 7 * body + 7));
      if (i % kLinks !== 0 && Math.abs(linkingNumber(core, ...pair)) !== 1) ++count;
    }
    return count;
  },
};

/// Bowls upon each other, mouths up (the bowl's mouth looks along z). They would touch at 0.63 units, and at 0.69 where their
/// places differ most.
const kBowl = unitOf('bowl', 1);
const stacks = groups('bowl', 5, 0.72 * kBowl, () => about([1, 0, 0], -Math.PI / 2));

export const kScenes = {
  heap: { ...heap('bunny'), title: 'bunnies that fall into a pit' },
  chains: { ...chains, title: `chains of ${kLinks} rings` },
  hooks: { ...heap('hook'), title: 'hooks that fall into a pit' },
  bowls: { ...stacks, title: 'stacks of 5 bowls' },
};

/// Ground and walls, as boxes: halfExtents and position. Inner faces are y = 0 and x, z = +-halfWidth.
export function pitBoxes(halfWidth, height = 40) {
  const t = kWallThickness;
  const wide = halfWidth + 2 * t;
  return [
    { halfExtents: [wide, t, wide], position: [0, -t, 0] },
    ...[-1, 1].flatMap((side) => [
      { halfExtents: [t, height / 2, wide], position: [side * (halfWidth + t), height / 2, 0] },
      { halfExtents: [wide, height / 2, t], position: [0, height / 2, side * (halfWidth + t)] },
    ]),
  ].map((box) => ({ ...box, rotation: kUpright }));
}

/// The same as half-spaces: bodies belong where the product with the normal is at least the offset.
export const pitFaces = (halfWidth) => [
  [0, 1, 0, 0],
  ...[-1, 1].flatMap((side) => [[side, 0, 0, -halfWidth], [0, 0, side, -halfWidth]]),
];

/// Bodies that are farther out than half their size, or nowhere: their pose, place or rotation, is no number.
export function countLost(poses, halfWidth) {
  let lost = 0;
  for (let at = 0; at < poses.length; at += 7) {
    const pose = poses.slice(at, at + 7);
    const [x, y, z] = pose;
    if (!(pose.every(Number.isFinite) && Math.abs(x) < halfWidth + 0.5 && Math.abs(z) < halfWidth + 0.5 && y > -0.5)) ++lost;
  }
  return lost;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where bodies start: a column over a pit, the same for every engine. Lengths are metres; y is up.

const kSpacing = 1.04; // of bodies a metre across: none touches another at the start
const kWallHalf = 0.5; // half of a wall's thickness

/// A generator of numbers in [0, 1): mulberry32.
export function randomFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/// A rotation, each as likely as any other (Shoemake).
function randomRotation(random) {
  const [u, v, w] = [random(), 2 * Math.PI * random(), 2 * Math.PI * random()];
  const [a, b] = [Math.sqrt(1 - u), Math.sqrt(u)];
  return [a * Math.sin(v), a * Math.cos(v), b * Math.sin(w), b * Math.cos(w)];
}

/// The pit of so many bodies: half its inner width, and how high its walls hold.
export function pitFor(count) {
  const half = Math.max(1.3, 0.47 * Math.cbrt(count));
  const perSide = Math.max(1, Math.floor((2 * half) / kSpacing));
  return { half, perSide, height: 3 + kSpacing * Math.ceil(count / perSide ** 2) };
}

/// Ground and four walls as boxes.
export function boxesOf({ half, height }) {
  const outer = half + 2 * kWallHalf;
  const wall = (x, z) => ({
    halfExtents: [x ? kWallHalf : outer, height / 2, z ? kWallHalf : outer],
    position: [x * (half + kWallHalf), height / 2, z * (half + kWallHalf)],
  });
  return [{ halfExtents: [outer, kWallHalf, outer], position: [0, -kWallHalf, 0] }, wall(1, 0), wall(-1, 0), wall(0, 1), wall(0, -1)];
}

/// Bodies of the models in turn, at random rotations. A pure function of its arguments.
export function startOf({ count, models, seed }) {
  const random = randomFrom(seed);
  const pit = pitFor(count);
  const { perSide } = pit;
  const bodies = Array.from({ length: count }, (_, index) => {
    const place = index % perSide ** 2;
    const column = [place % perSide, Math.floor(place / perSide)].map((k) => (k - (perSide - 1) / 2) * kSpacing + 0.02 * (random() - 0.5));
    const height = 0.7 + kSpacing * Math.floor(index / perSide ** 2);
    return { model: models[Math.floor(random() * models.length)], position: [column[0], height, column[1]], rotation: randomRotation(random) };
  });
  return { pit, bodies };
}

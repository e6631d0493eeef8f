// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kinematics of URDF: where links are, as their joints stand. Positions are radians or units of length.

const kMoving = ['revolute', 'continuous', 'prismatic'];

/// Whether a joint has a position of its own.
export const isActive = (joint) => kMoving.includes(joint.type) && !joint.mimic;

export const clamped = ({ lower, upper }, position) => Math.min(Math.max(position, lower), upper);

/// Position 0, or the end of the range that is nearest to it.
export const defaultPosition = (joint) => clamped(joint, 0);

/// The position of each joint, those that follow others included.
export function allPositions(joints, positions) {
  return joints.map(({ mimic }, j) => (mimic ? mimic.multiplier * positions[mimic.joint] + mimic.offset : positions[j]));
}

/// A turn about a unit vector as nine numbers, row by row (Rodrigues's formula).
function turnAbout([x, y, z], angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const t = 1 - c;
  return [
    t * x * x + c, t * x * y - s * z, t * x * z + s * y,
    t * x * y + s * z, t * y * y + c, t * y * z - s * x,
    t * x * z - s * y, t * y * z + s * x, t * z * z + c,
  ];
}

const kIdentity = { rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: [0, 0, 0] };

const rotated = (m, [x, y, z]) => [0, 3, 6].map((row) => m[row] * x + m[row + 1] * y + m[row + 2] * z);

const product = (a, b) => a.map((_, k) => [0, 1, 2].reduce((sum, i) => sum + a[3 * Math.floor(k / 3) + i] * b[3 * i + (k % 3)], 0));

/// First `b`, then `a`.
function composed(a, b) {
  const moved = rotated(a.rotation, b.translation);
  return { rotation: product(a.rotation, b.rotation), translation: moved.map((c, k) => c + a.translation[k]) };
}

function motionOf(joint, position) {
  if (joint.type === 'prismatic') return { ...kIdentity, translation: joint.axis.map((c) => c * position) };
  return kMoving.includes(joint.type) ? { ...kIdentity, rotation: turnAbout(joint.axis, position) } : kIdentity;
}

/// The joints, each after the one its parent hangs on.
export function parentsFirst(linkCount, joints) {
  const hanging = Array.from({ length: linkCount }, () => []);
  const isChild = new Array(linkCount).fill(false);
  joints.forEach(({ parent, child }, j) => {
    hanging[parent].push(j);
    isChild[child] = true;
  });
  const order = isChild.flatMap((is, link) => (is ? [] : hanging[link]));
  for (let i = 0; i < order.length; ++i) order.push(...hanging[joints[order[i]].child]);
  return order;
}

/// Poses of all links: `rotation * p + translation` leads from a link's frame into the root's.
export function linkPoses(linkCount, joints, order, positions) {
  const all = allPositions(joints, positions);
  const poses = new Array(linkCount).fill(kIdentity);
  for (const j of order) poses[joints[j].child] = composed(composed(poses[joints[j].parent], joints[j]), motionOf(joints[j], all[j]));
  return poses;
}

/// A point of a link's frame in the root's.
export const placed = ({ rotation, translation }, point) => rotated(rotation, point).map((c, k) => c + translation[k]);

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two closed curves hang in each other.
import { add, cross, dot, length, rotate, scale, subtract } from '../engines/vectors.mjs';

const placed = (curve, pose) => curve.map((point) => add(rotate(pose.slice(3), point), pose.slice(0, 3)));
const unit = (v) => scale(v, 1 / (length(v) || 1));

/// The signed solid angle, over 4 pi, that two straight pieces show each other (Klenin and Langowski 2000, method 1a).
function partOf(a, b, c, d) {
  const [ac, ad, bc, bd] = [subtract(c, a), subtract(d, a), subtract(c, b), subtract(d, b)];
  const n = [cross(ac, ad), cross(ad, bd), cross(bd, bc), cross(bc, ac)].map(unit);
  const angle = [0, 1, 2, 3].reduce((sum, k) => sum + Math.asin(Math.max(-1, Math.min(1, dot(n[k], n[(k + 1) % 4])))), 0);
  return (angle * Math.sign(dot(cross(subtract(d, c), subtract(b, a)), ac))) / (4 * Math.PI);
}

/// Of a closed curve at two poses (position and rotation, seven numbers each): 0 where they are apart.
export function linkingNumber(curve, poseA, poseB) {
  const [a, b] = [placed(curve, [...poseA]), placed(curve, [...poseB])];
  let sum = 0;
  a.forEach((from, i) => b.forEach((other, j) => (sum += partOf(from, a[(i + 1) % a.length], other, b[(j + 1) % b.length]))));
  return Math.round(sum);
}

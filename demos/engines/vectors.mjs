// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors and quaternions as arrays.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);

/// The vector `v` turned by the unit quaternion `q` (x y z w).
export function rotate(q, v) {
  const t = scale(cross(q, v), 2);
  return add(add(v, scale(t, q[3])), cross(q, t));
}

/// The unit quaternion of a rotation given by its three columns.
export function quaternionOf([a, b, c]) {
  const [xx, yy, zz] = [a[0], b[1], c[2]];
  const parts = [1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz];
  const most = parts.indexOf(Math.max(...parts)); // the part that is surely not small
  const q = [
    [parts[0], b[0] + a[1], c[0] + a[2], b[2] - c[1]],
    [b[0] + a[1], parts[1], c[1] + b[2], c[0] - a[2]],
    [c[0] + a[2], c[1] + b[2], parts[2], a[1] - b[0]],
    [b[2] - c[1], c[0] - a[2], a[1] - b[0], parts[3]],
  ][most];
  return q.map((part) => part / Math.hypot(...q));
}

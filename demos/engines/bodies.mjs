// SPDX-License-Identifier: GPL-3.0-or-later
//
// Concave bodies by formula: closed meshes that nobody owns, one metre across, with the centre of mass at the origin.
import { massProperties, signedVolume } from './mass.mjs';
import { add, cross, dot, length, scale, subtract } from './vectors.mjs';

const unit = (v) => scale(v, 1 / length(v));

/// Joins rows of as many points each into a surface. `closed` joins the last row to the first; else `ends` holds two points
/// that close it.
function surfaceOf(rows, { closed, ends }) {
  const sides = rows[0].length;
  const points = rows.flat();
  const triangles = [];
  const at = (row, side) => (row % rows.length) * sides + (side % sides);
  for (let row = 0; row < rows.length - (closed ? 0 : 1); ++row) {
    for (let side = 0; side < sides; ++side) {
      triangles.push([at(row, side), at(row, side + 1), at(row + 1, side + 1)], [at(row, side), at(row + 1, side + 1), at(row + 1, side)]);
    }
  }
  if (!closed) {
    const [first, last] = [points.push(ends[0]) - 1, points.push(ends[1]) - 1];
    for (let side = 0; side < sides; ++side) {
      triangles.push([first, at(0, side + 1), at(0, side)], [last, at(rows.length - 1, side), at(rows.length - 1, side + 1)]);
    }
  }
  return { vertices: Float32Array.from(points.flat()), indices: Uint32Array.from(triangles.flat()) };
}

/// A tube around a curve given by points, its sides turned as little as possible from one point to the next.
function tube(curve, radius, sides, closed) {
  const count = curve.length;
  const tangents = curve.map((_, k) => {
    const [before, after] = closed ? [curve[(k + count - 1) % count], curve[(k + 1) % count]] : [curve[Math.max(k - 1, 0)], curve[Math.min(k + 1, count - 1)]];
    return unit(subtract(after, before));
  });
  const normals = [];
  tangents.forEach((tangent, k) => {
    const last = normals[k - 1] ?? (Math.abs(tangent[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
    normals.push(unit(subtract(last, scale(tangent, dot(last, tangent)))));
  });
  // A closed tube meets itself turned by some angle, which is spread over all rows.
  const across = cross(tangents[0], normals[0]);
  const turn = closed ? Math.atan2(dot(normals[count - 1], across), dot(normals[count - 1], normals[0])) : 0;
  const ring = (k, size, shift) => {
    const center = add(curve[k], scale(tangents[k], shift));
    const sideways = cross(tangents[k], normals[k]);
    return Array.from({ length: sides }, (_, side) => {
      const angle = (2 * Math.PI * side) / sides - (turn * k) / count;
      return add(center, add(scale(normals[k], size * Math.cos(angle)), scale(sideways, size * Math.sin(angle))));
    });
  };
  const rows = curve.map((_, k) => ring(k, radius, 0));
  if (closed) return surfaceOf(rows, { closed });
  const caps = [30, 60].map((degrees) => [radius * Math.cos((degrees * Math.PI) / 180), radius * Math.sin((degrees * Math.PI) / 180)]);
  for (const [size, shift] of caps) {
    rows.unshift(ring(0, size, -shift));
    rows.push(ring(count - 1, size, shift));
  }
  const ends = [subtract(curve[0], scale(tangents[0], radius)), add(curve[count - 1], scale(tangents[count - 1], radius))];
  return surfaceOf(rows, { ends });
}

const angles = (count, from, to, closed) => Array.from({ length: count }, (_, k) => from + ((to - from) * k) / (closed ? count : count - 1));

const ring = () => tube(angles(36, 0, 2 * Math.PI, true).map((t) => [Math.cos(t), Math.sin(t), 0]), 0.3, 14, true);

const knot = () => {
  const curve = angles(80, 0, 2 * Math.PI, true).map((t) => [Math.sin(t) + 2 * Math.sin(2 * t), Math.cos(t) - 2 * Math.cos(2 * t), -1.2 * Math.sin(3 * t)]);
  return tube(curve, 0.5, 10, true);
};

/// A straight shank that ends in three quarters of a circle.
const hook = () => {
  const shank = angles(8, 2.6, 0.2, false).map((y) => [1, y, 0]);
  const bend = angles(22, 0, -1.4 * Math.PI, false).map((t) => [Math.cos(t), Math.sin(t), 0]);
  return tube([...shank, ...bend], 0.3, 12, false);
};

/// A link of a chain.
const link = () => {
  const half = (sign) => angles(15, -Math.PI / 2, Math.PI / 2, false).map((t) => [sign * (0.8 + Math.cos(t)), sign * Math.sin(t), 0]);
  const side = (sign) => [0.4, 0, -0.4].map((x) => [sign * x, sign, 0]);
  return tube([...half(1), ...side(1), ...half(-1), ...side(-1)], 0.28, 12, true);
};

/// A thick bowl: outer half sphere, rounded rim, inner half sphere.
const bowl = () => {
  const profile = [
    ...angles(13, -75, 0, false).map((d) => [Math.cos((d * Math.PI) / 180), Math.sin((d * Math.PI) / 180)]),
    ...[45, 90, 135].map((d) => [0.9 + 0.1 * Math.cos((d * Math.PI) / 180), 0.1 * Math.sin((d * Math.PI) / 180)]),
    ...angles(11, 0, -75, false).map((d) => [0.8 * Math.cos((d * Math.PI) / 180), 0.8 * Math.sin((d * Math.PI) / 180)]),
  ];
  const rows = profile.map(([r, z]) => angles(28, 0, 2 * Math.PI, true).map((t) => [r * Math.cos(t), r * Math.sin(t), z]));
  return surfaceOf(rows, { ends: [[0, 0, profile[0][1]], [0, 0, profile.at(-1)[1]]] });
};

const kMakers = { ring, bowl, hook, link, knot };
export const kBodies = Object.keys(kMakers);

/// Turns triangles outward, moves the centre of mass to the origin and scales the bounding box's diagonal to one metre.
export function standard(name, { vertices, indices }, mass) {
  if (signedVolume({ vertices, indices }) < 0) for (let at = 0; at < indices.length; at += 3) [indices[at], indices[at + 1]] = [indices[at + 1], indices[at]];
  const { center } = massProperties({ name, vertices, indices, mass });
  const low = [0, 1, 2].map((c) => vertices.reduce((least, value, at) => (at % 3 === c ? Math.min(least, value) : least), Infinity));
  const high = [0, 1, 2].map((c) => vertices.reduce((most, value, at) => (at % 3 === c ? Math.max(most, value) : most), -Infinity));
  const size = length(subtract(high, low));
  return { name, vertices: vertices.map((value, at) => (value - center[at % 3]) / size), indices, mass };
}

/// A body by its name, of one kilogram.
export function makeBody(name) {
  if (!kMakers[name]) throw new Error(`no body is named ${name}; choose one of ${kBodies.join(', ')}.`);
  return standard(name, kMakers[name](), 1);
}

/// Text of a mesh as Wavefront OBJ. Nine digits give each float again.
export function objOf({ vertices, indices }) {
  const lines = [];
  for (let at = 0; at < vertices.length; at += 3) lines.push(`v ${[...vertices.subarray(at, at + 3)].map((value) => value.toPrecision(9)).join(' ')}`);
  for (let at = 0; at < indices.length; at += 3) lines.push(`f ${[...indices.subarray(at, at + 3)].map((index) => index + 1).join(' ')}`);
  return `${lines.join('\n')}\n`;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mass properties of a solid of constant density, the same for every engine: what they make of their own shapes differs.
import { cross, dot, quaternionOf } from './vectors.mjs';

/// Moments of the solid inside a closed mesh: volume, first moments, and second moments about the frame's origin.
function momentsOf(vertices, indices) {
  let volume = 0;
  const first = [0, 0, 0];
  const second = [0, 1, 2].map(() => [0, 0, 0]);
  for (let at = 0; at < indices.length; at += 3) {
    const p = [0, 1, 2].map((k) => [0, 1, 2].map((c) => vertices[3 * indices[at + k] + c]));
    const part = dot(p[0], cross(p[1], p[2])) / 6; // the tetrahedron to the origin, with sign
    const sum = [0, 1, 2].map((c) => p[0][c] + p[1][c] + p[2][c]);
    volume += part;
    for (let i = 0; i < 3; ++i) {
      first[i] += (part * sum[i]) / 4;
      for (let j = 0; j < 3; ++j) {
        const products = p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j];
        second[i][j] += (part * (products + sum[i] * sum[j])) / 20;
      }
    }
  }
  return { volume, first, second };
}

export const signedVolume = ({ vertices, indices }) => momentsOf(vertices, indices).volume;

/// Eigenvalues and eigenvectors (columns of a rotation) of a symmetric matrix, by Jacobi's rotations.
export function principalAxes(matrix) {
  const a = matrix.map((row) => [...row]);
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; ++sweep) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(a[p][q]) <= 1e-15 * (Math.abs(a[p][p]) + Math.abs(a[q][q]))) continue;
      const half = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = Math.sign(half || 1) / (Math.abs(half) + Math.hypot(half, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (let k = 0; k < 3; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      for (let k = 0; k < 3; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
      for (let k = 0; k < 3; ++k) {
        [columns[p][k], columns[q][k]] = [c * columns[p][k] - s * columns[q][k], s * columns[p][k] + c * columns[q][k]];
      }
    }
  }
  if (dot(columns[0], cross(columns[1], columns[2])) < 0) columns[2] = columns[2].map((part) => -part);
  return { values: [a[0][0], a[1][1], a[2][2]], columns };
}

/// Centre of mass, inertia about it (as a matrix, and as principal moments with the rotation of their axes).
export function massProperties({ name, vertices, indices, mass }) {
  const { volume, first, second } = momentsOf(vertices, indices);
  if (!(volume > 0)) throw new Error(`${name}: the mesh encloses no volume; give a closed mesh whose triangles face outward.`);
  const center = first.map((part) => part / volume);
  const density = mass / volume;
  const spread = second.map((row, i) => row.map((part, j) => density * (part - volume * center[i] * center[j])));
  const trace = spread[0][0] + spread[1][1] + spread[2][2];
  const inertia = spread.map((row, i) => row.map((part, j) => (i === j ? trace : 0) - part));
  const { values, columns } = principalAxes(inertia);
  return { mass, volume, center, inertia, moments: values, axes: quaternionOf(columns) };
}

// SPDX-License-Identifier: GPL-3.0-or-later

/// A closed mesh as Wavefront OBJ: an octahedron divided `times` times, with bumps of a height; 8 * 4^times triangles.
export function bumpyBall(times, height = 0.18, waves = 1) {
  const vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  let triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
  const middles = new Map();
  const middle = (a, b) => {
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    if (!middles.has(key)) {
      const sum = vertices[a].map((c, k) => c + vertices[b][k]);
      middles.set(key, vertices.push(sum.map((c) => c / Math.hypot(...sum))) - 1);
    }
    return middles.get(key);
  };
  for (let i = 0; i < times; ++i)
    triangles = triangles.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  const bumpy = vertices.map(([x, y, z]) => [x, y, z].map((c) => c * (1 + height * Math.sin(5 * waves * x) * Math.cos(waves * (4 * y + 3 * z)))));
  return [...bumpy.map((v) => `v ${v.join(' ')}`), ...triangles.map((t) => `f ${t.map((i) => i + 1).join(' ')}`)].join('\n') + '\n';
}

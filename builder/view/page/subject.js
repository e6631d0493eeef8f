// SPDX-License-Identifier: GPL-3.0-or-later
import { placed } from './joints.js';

/// Calls back with every vertex, and the ends of the spheres of links without any, in the picture's frame.
function forPoints({ links, whole }, poses, visit) {
  links.forEach(({ vertices, origin }, l) => {
    for (let i = 0; i < vertices.length; i += 3) visit(placed(poses[l], [0, 1, 2].map((k) => origin[k] + vertices[i + k])));
  });
  for (let node = 0; node < whole.count; ++node) {
    if (links[whole.owner[node]].vertices.length > 0) continue;
    for (let k = 0; k < 3; ++k)
      for (const sign of [-1, 1]) {
        const point = [...whole.centers.subarray(3 * node, 3 * node + 3)];
        point[k] += sign * whole.radii[node];
        visit(point);
      }
  }
}

/// The middle of the box around all that is shown, and how far it reaches from there.
export function subjectOf(scene, poses) {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  forPoints(scene, poses, (point) => {
    for (let k = 0; k < 3; ++k) {
      lower[k] = Math.min(lower[k], point[k]);
      upper[k] = Math.max(upper[k], point[k]);
    }
  });
  const middle = lower.map((l, k) => (l + upper[k]) / 2);
  let radius = 0;
  forPoints(scene, poses, (point) => (radius = Math.max(radius, Math.hypot(...middle.map((m, k) => point[k] - m)))));
  return { middle, radius };
}

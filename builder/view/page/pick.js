// SPDX-License-Identifier: GPL-3.0-or-later

/// The first sphere of a cut that a ray meets, or null. The ray is in the unit of the scene, of which a file's unit is
/// `unit` long.
export function firstSphereHit(link, unit, cut, { eye, direction }) {
  let first = null;
  let least = Infinity;
  for (const i of cut) {
    const to = [0, 1, 2].map((k) => link.centers[3 * i + k] * unit - eye[k]);
    const along = to[0] * direction[0] + to[1] * direction[1] + to[2] * direction[2];
    const besideSq = [0, 1, 2].reduce((sum, k) => sum + (to[k] - along * direction[k]) ** 2, 0);
    const halfChordSq = (link.radii[i] * unit) ** 2 - besideSq;
    if (halfChordSq < 0) continue;
    const at = along - Math.sqrt(halfChordSq);
    if (at <= 0 || at >= least) continue;
    least = at;
    first = i;
  }
  return first;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a tree holds, as other commands tell it: nothing here comes from the page or its writer.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { cairn } from './browser.mjs';

/// The spheres of a tree from `cairn export --to spheres`, and its levels from `cairn inspect`.
export function truthOf(program, tree, folder) {
  const text = join(folder, 'spheres.txt');
  cairn(program, 'export', tree, '--to', 'spheres', '-o', text);
  const spheres = readFileSync(text, 'utf8')
    .trim()
    .split('\n')
    .map((line) => line.split(' ').map(Number))
    .map(([level, x, y, z, radius, parent]) => ({ level, center: [x, y, z], radius, parent, children: [] }));
  spheres.forEach((sphere, i) => sphere.parent >= 0 && spheres[sphere.parent].children.push(i));
  return { spheres, ...JSON.parse(cairn(program, 'inspect', tree, '--json', '-')) };
}

/// The spheres one sees on a level: its own, and the leaves above it.
export function cutOf({ spheres }, level) {
  return [...spheres.keys()].filter((i) => spheres[i].level === level || (spheres[i].level < level && spheres[i].children.length === 0));
}

/// Those of a cut whose middle nothing hides from the eye: the ray to the middle meets no other sphere sooner, were these
/// larger by `pixel`, a length.
export function seenFrom(eye, { spheres }, cut, pixel = 0) {
  const entry = (target, sphere) => {
    const to = sphere.center.map((c, k) => c - eye[k]);
    const ray = target.center.map((c, k) => c - eye[k]);
    const length = Math.hypot(...ray);
    const along = to.reduce((sum, c, k) => sum + (c * ray[k]) / length, 0);
    const chordSq = sphere.radius ** 2 - to.reduce((sum, c) => sum + c * c, 0) + along * along;
    return chordSq > 0 ? along - Math.sqrt(chordSq) : Infinity;
  };
  return cut.filter((i) => {
    const own = entry(spheres[i], spheres[i]);
    // A sphere that is in front by less than a thousandth may be either one's pixel.
    const larger = ({ center, radius }) => ({ center, radius: radius + pixel });
    return cut.every((j) => j === i || entry(spheres[i], larger(spheres[j])) > own + 1e-3 * spheres[i].radius);
  });
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The data of the page, decoded: links with a mesh and a tree of spheres each, in the unit of their files.
import { lengthText } from './colors.js';
import { linked, wholeOf } from './whole.js';

const kFormat = 1;

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const kLittleEndian = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;

/// Numbers of 32 bits each, little-endian in the page.
function unpacked(base64, Type) {
  const bytes = bytesOf(base64);
  if (!kLittleEndian) for (let i = 0; i < bytes.length; i += 4) bytes.subarray(i, i + 4).reverse();
  return new Type(bytes.buffer);
}

function linkOf(json) {
  const parents = unpacked(json.spheres.parents, Uint32Array);
  const link = {
    name: json.name,
    origin: json.origin,
    diagonal: json.diagonal,
    vertices: unpacked(json.mesh.vertices, Float32Array),
    triangles: unpacked(json.mesh.triangles, Uint32Array),
    centers: unpacked(json.spheres.centers, Float32Array),
    radii: unpacked(json.spheres.radii, Float32Array),
    errors: unpacked(json.spheres.errors, Float32Array),
    innerRadii: unpacked(json.spheres.inner_radii, Float32Array),
    firstTriangles: unpacked(json.spheres.first_triangles, Uint32Array),
    triangleCounts: unpacked(json.spheres.triangle_counts, Uint32Array),
    regionTriangles: unpacked(json.spheres.region_triangles, Uint32Array),
    parents,
    count: parents.length,
    ...linked(parents),
  };
  link.depth = link.count === 0 ? 0 : link.levels[link.count - 1];
  return link;
}

export function readScene(text) {
  const json = JSON.parse(text);
  if (json.format !== kFormat) throw new Error(`data of format ${json.format}; this viewer reads ${kFormat}`);
  const links = json.links.map(linkOf);
  const isMetric = json.unit === 'm';
  return {
    title: json.title,
    facts: json.facts,
    links,
    whole: wholeOf(links),
    joints: json.joints,
    ignored: json.ignored_pairs,
    up: json.up,
    isMetric,
    isRobot: links.length > 1 || json.joints.length > 0,
    /// Lengths for the reader.
    length: (...values) => values.map((value) => lengthText(isMetric ? 1000 * value : value)).join(', ') + (isMetric ? ' mm' : ''),
  };
}

/// The triangles a sphere holds a part of. The data lists one again for every leaf that it lies in.
export function trianglesOf(link, node) {
  const first = link.firstTriangles[node];
  return new Set(link.regionTriangles.subarray(first, first + link.triangleCounts[node]));
}

/// The spheres of a level: its nodes, and the leaves above it.
export function levelCut(link, level) {
  const cut = [];
  for (let i = 0; i < link.count && link.levels[i] <= level; ++i)
    if (link.levels[i] === level || link.childCount[i] === 0) cut.push(i);
  return Uint32Array.from(cut);
}

/// That of some spheres with the greatest certified error; null where nothing is certified.
export function worstOf(link, cut) {
  let worst = null;
  for (const i of cut) if (!Number.isNaN(link.errors[i]) && (worst === null || link.errors[i] > link.errors[worst])) worst = i;
  return worst;
}

/// The shallowest level whose spheres show the shape, and not yet a texture.
export function levelToBeginWith(link) {
  const kEnough = 48; // spheres; a tree of branching 8 has 64 on level 2
  for (let level = 0; level < link.depth; ++level) if (levelCut(link, level).length >= kEnough) return level;
  return link.depth;
}

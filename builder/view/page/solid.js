// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh: smooth where it is smooth, with lines along its edges.
import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Mesh, RawShaderMaterial, Vector3 } from 'three';
import { kAlarmColor } from './colors.js';
import { placed } from './joints.js';
import shading from './shading.glsl';
import solidFragment from './solid.frag.glsl';
import solidVertex from './solid.vert.glsl';

// Neighbours that meet flatter than this share a normal; sharper ones are an edge. 40 degrees keep a bunny of 1500
// triangles smooth and a cylinder's rim sharp.
const kSmooth = Math.cos((40 * Math.PI) / 180);

const kAlarmShare = 0.55; // of the colour of overlaps in that of a mesh

/// Unit normals of the triangles, and twice their areas.
function faceNormals({ vertices, triangles }) {
  const count = triangles.length / 3;
  const normals = new Float32Array(3 * count);
  const areas = new Float32Array(count);
  for (let t = 0; t < count; ++t) {
    const [a, b, c] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
    const u = [0, 1, 2].map((k) => vertices[b + k] - vertices[a + k]);
    const v = [0, 1, 2].map((k) => vertices[c + k] - vertices[a + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    areas[t] = Math.hypot(...n);
    for (let k = 0; k < 3; ++k) normals[3 * t + k] = areas[t] > 0 ? n[k] / areas[t] : k === 2;
  }
  return { normals, areas };
}

/// The triangles around each vertex: those of vertex v are list[first[v]] up to list[first[v + 1]].
function trianglesAround({ vertices, triangles }) {
  const first = new Uint32Array(vertices.length / 3 + 1);
  for (const v of triangles) ++first[v + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const next = first.slice();
  const list = new Uint32Array(triangles.length);
  triangles.forEach((v, k) => (list[next[v]++] = Math.floor(k / 3)));
  return { first, list };
}

const dot = (array, a, b) => array[a] * array[b] + array[a + 1] * array[b + 1] + array[a + 2] * array[b + 2];

/// For each corner of each triangle its normal, and whether the surface folds along the edge opposite to it.
function cornersOf(link) {
  const { triangles } = link;
  const { normals, areas } = faceNormals(link);
  const { first, list } = trianglesAround(link);
  const cornerNormals = new Float32Array(3 * triangles.length);
  const edges = new Uint8Array(4 * triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const t = Math.floor(corner / 3);
    const v = triangles[corner];
    const sum = [0, 0, 0];
    for (let at = first[v]; at < first[v + 1]; ++at) {
      const other = list[at];
      if (dot(normals, 3 * t, 3 * other) < kSmooth) continue;
      for (let k = 0; k < 3; ++k) sum[k] += areas[other] * normals[3 * other + k];
    }
    const size = Math.hypot(...sum) || 1;
    for (let k = 0; k < 3; ++k) cornerNormals[3 * corner + k] = sum[k] / size;
    edges.set(foldsOf(t), 4 * corner);
  }
  return { cornerNormals, edges };

  function foldsOf(t) {
    return [0, 1, 2].map((k) => {
      const [a, b] = [triangles[3 * t + ((k + 1) % 3)], triangles[3 * t + ((k + 2) % 3)]];
      let folds = true; // as the edge of an open surface is
      for (let at = first[a]; at < first[a + 1]; ++at) {
        const other = list[at];
        const shares = other !== t && [0, 1, 2].some((j) => triangles[3 * other + j] === b);
        if (shares) folds = dot(normals, 3 * t, 3 * other) < kSmooth;
      }
      return folds ? 255 : 0;
    });
  }
}

/// The mesh of a link. `object` goes into the scene; `unit` is the length of the file's unit there.
export class Solid {
  constructor(link, unit) {
    const { vertices, triangles } = link;
    const { cornerNormals, edges } = cornersOf(link);
    const positions = new Float32Array(3 * triangles.length);
    triangles.forEach((v, corner) => {
      for (let k = 0; k < 3; ++k) positions[3 * corner + k] = vertices[3 * v + k] * unit;
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(cornerNormals, 3));
    geometry.setAttribute('edges', new BufferAttribute(edges, 4, true));
    this.edges_ = geometry.attributes.edges;
    this.object = new Mesh(
      geometry,
      new RawShaderMaterial({
        glslVersion: GLSL3,
        side: DoubleSide,
        vertexShader: solidVertex,
        fragmentShader: solidFragment.replace('void main', `${shading}\nvoid main`),
        uniforms: {
          stone: { value: new Vector3() },
          mark: { value: new Vector3() },
          ink: { value: new Vector3() },
          wire: { value: 1 },
        },
      }),
    );
    this.object.frustumCulled = false;
    this.object.matrixAutoUpdate = false;
    this.origin_ = link.origin;
    this.unit_ = unit;
    this.hasAlarm_ = false;
    this.stone_ = [0, 0, 0];
  }

  /// Moves the mesh to where its link is.
  place(pose) {
    const [x, y, z] = placed(pose, this.origin_).map((c) => c * this.unit_);
    const r = pose.rotation;
    this.object.matrix.set(r[0], r[1], r[2], x, r[3], r[4], r[5], y, r[6], r[7], r[8], z, 0, 0, 0, 1);
    this.object.matrixWorldNeedsUpdate = true;
  }

  /// Shows the mesh in the colour of links that overlap, or in its own.
  setAlarm(hasAlarm) {
    this.hasAlarm_ = hasAlarm;
    this.applyStone();
  }

  applyStone() {
    const stone = this.stone_.map((c, k) => (this.hasAlarm_ ? c + kAlarmShare * (kAlarmColor[k] - c) : c));
    this.object.material.uniforms.stone.value.set(...stone);
  }

  setColors({ stone, mark, ink }) {
    const { uniforms } = this.object.material;
    this.stone_ = stone;
    this.applyStone();
    uniforms.mark.value.set(...mark);
    uniforms.ink.value.set(...ink);
  }

  setWire(shown) {
    this.object.material.uniforms.wire.value = shown ? 1 : 0;
  }

  /// Marks some triangles, and no others.
  mark(triangles) {
    const { array } = this.edges_;
    for (let k = 3; k < array.length; k += 4) array[k] = 0;
    for (const t of triangles) for (let corner = 3 * t; corner < 3 * t + 3; ++corner) array[4 * corner + 3] = 255;
    this.edges_.needsUpdate = true;
  }
}

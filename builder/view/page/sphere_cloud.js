// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spheres as squares on which the shader finds the ball; what a square stands for is in textures.
import {
  BufferAttribute,
  BufferGeometry,
  CustomBlending,
  DataTexture,
  DynamicDrawUsage,
  FloatType,
  GLSL3,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  RGBAFormat,
  RGFormat,
  RawShaderMaterial,
  SrcAlphaFactor,
  Vector3,
} from 'three';
import ringFragment from './ring.frag.glsl';
import sphereFragment from './sphere.frag.glsl';
import sphereVertex from './sphere.vert.glsl';

const kRow = 1024; // spheres in a row of a texture, as the shaders have it

function textureFor(capacity, format, channels) {
  const height = Math.max(1, Math.ceil(capacity / kRow));
  return new DataTexture(new Float32Array(channels * kRow * height), kRow, height, format, FloatType);
}

/// Squares of spheres, of which the first so many are drawn.
class Squares {
  constructor(capacity, material) {
    this.balls = textureFor(capacity, RGBAFormat, 4);
    this.indices_ = new BufferAttribute(new Uint32Array(6 * capacity), 1).setUsage(DynamicDrawUsage);
    this.geometry_ = new BufferGeometry();
    this.geometry_.setIndex(this.indices_);
    material.uniforms.balls.value = this.balls;
    this.object = new Mesh(this.geometry_, material);
    this.object.frustumCulled = false; // where it is stands in the texture
    this.count = 0;
  }

  setBall(k, link, unit, i) {
    const { data } = this.balls.image;
    for (let axis = 0; axis < 3; ++axis) data[4 * k + axis] = link.centers[3 * i + axis] * unit;
    data[4 * k + 3] = link.radii[i] * unit;
  }

  setCount(count) {
    this.count = count;
    this.balls.needsUpdate = true;
    this.geometry_.setDrawRange(0, 6 * count);
    for (let k = 0; k < count; ++k) this.putSquare(k, k);
    this.indices_.needsUpdate = true;
  }

  putSquare(place, k) {
    const { array } = this.indices_;
    const [at, first] = [6 * place, 4 * k];
    array[at] = array[at + 3] = first;
    array[at + 1] = first + 1;
    array[at + 2] = array[at + 4] = first + 2;
    array[at + 5] = first + 3;
  }

  /// Draws what is near first: what it hides is then left out early. `ahead` is the direction of view.
  sort(ahead) {
    const kBuckets = 512;
    const { data } = this.balls.image;
    const { count } = this;
    const depths = new Float64Array(count); // as exact as `least`, or the nearest one would get no bucket
    let [least, most] = [Infinity, -Infinity];
    for (let k = 0; k < count; ++k) {
      const depth = data[4 * k] * ahead.x + data[4 * k + 1] * ahead.y + data[4 * k + 2] * ahead.z - data[4 * k + 3];
      depths[k] = depth;
      least = Math.min(least, depth);
      most = Math.max(most, depth);
    }
    const scale = most > least ? (kBuckets - 1) / (most - least) : 0;
    const first = new Uint32Array(kBuckets + 1);
    for (let k = 0; k < count; ++k) ++first[Math.floor((depths[k] - least) * scale) + 1];
    for (let b = 1; b <= kBuckets; ++b) first[b] += first[b - 1];
    for (let k = 0; k < count; ++k) this.putSquare(first[Math.floor((depths[k] - least) * scale)]++, k);
    this.indices_.needsUpdate = true;
  }
}

/// The most spheres a level has.
function largestCut(link) {
  const nodes = new Uint32Array(link.depth + 1);
  const leavesAbove = new Uint32Array(link.depth + 2);
  for (let i = 0; i < link.count; ++i) {
    ++nodes[link.levels[i]];
    if (link.childCount[i] === 0) ++leavesAbove[link.levels[i] + 1];
  }
  let most = 0;
  for (let level = 0, above = 0; level <= link.depth; ++level) {
    above += leavesAbove[level];
    most = Math.max(most, nodes[level] + above);
  }
  return most;
}

/// What the shader takes the colour of a sphere from: its share of the scale; -1 for one without a certified error; 2 and
/// 3 for one of an overlapping link.
function lookOf({ errors, alarms }, i, greatest) {
  if (alarms[i] > 0) return 1 + alarms[i];
  if (Number.isNaN(errors[i])) return -1;
  return greatest > 0 ? errors[i] / greatest : 0;
}

/// The spheres of a level. `object` goes into a scene; `unit` is the length of the file's unit there.
export class SphereCloud {
  constructor(link, unit) {
    this.link_ = link;
    this.unit_ = unit;
    const capacity = largestCut(link);
    this.looks = textureFor(capacity, RGFormat, 2);
    this.squares_ = new Squares(
      capacity,
      new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: sphereVertex,
        fragmentShader: `#extension GL_EXT_conservative_depth : enable\n${sphereFragment}`,
        uniforms: { balls: { value: null } },
      }),
    );
    this.object = this.squares_.object;
    this.balls = this.squares_.balls;
  }

  get count() {
    return this.squares_.count;
  }

  /// Shows the spheres `cut`, coloured from error 0 to `greatest`; `chosen` is one of them or null.
  show(cut, greatest, chosen) {
    const { data } = this.looks.image;
    cut.forEach((i, k) => {
      this.squares_.setBall(k, this.link_, this.unit_, i);
      data[2 * k] = lookOf(this.link_, i, greatest);
      data[2 * k + 1] = i === chosen ? 1 : 0;
    });
    this.looks.needsUpdate = true;
    this.squares_.setCount(cut.length);
  }

  sort(ahead) {
    this.squares_.sort(ahead);
  }
}

/// The outline of one sphere, drawn over everything.
export class Ring {
  constructor(link, unit, { lineWidth, haze }) {
    this.link_ = link;
    this.unit_ = unit;
    this.lineWidth_ = lineWidth;
    const uniforms = { balls: { value: null }, ink: { value: new Vector3() }, lineWidth: { value: 1 }, haze: { value: haze } };
    this.uniforms_ = uniforms;
    this.squares_ = new Squares(
      1,
      new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: sphereVertex,
        fragmentShader: ringFragment,
        uniforms,
        depthTest: false,
        depthWrite: false,
        transparent: true,
        blending: CustomBlending,
        blendSrc: SrcAlphaFactor,
        blendDst: OneMinusSrcAlphaFactor,
        blendSrcAlpha: OneFactor,
        blendDstAlpha: OneMinusSrcAlphaFactor,
      }),
    );
    this.object = this.squares_.object;
    this.object.visible = false;
  }

  /// Shows the outline of a sphere, or of none for null.
  show(sphere) {
    this.object.visible = sphere !== null;
    if (sphere === null) return;
    this.squares_.setBall(0, this.link_, this.unit_, sphere);
    this.squares_.setCount(1);
  }

  setInk(rgb, pixelRatio) {
    this.uniforms_.ink.value.set(...rgb);
    this.uniforms_.lineWidth.value = this.lineWidth_ * pixelRatio;
  }
}

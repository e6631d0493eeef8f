// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact points: discs coloured by certified error, smaller ones where no load is borne, diamonds where a pair was not resolved.
// Drawn through the bodies, as contacts lie between them.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, ShaderMaterial } from 'three';
import { errorColor, kGreatestShown } from './colors.js';

export const kContactNumbers = 12; // a row: point, normal, depth, error, bodies a and b, impulse, measured on meshes or not
const kMost = 8192;
const kRounding = 1 + 1e-6; // errors come as floats
// Sizes in CSS pixels: of contacts that bear nothing, of those that do, and of pairs that were not resolved.
const kFree = 4;
const kLoaded = 8;
const kOpen = 12;

const kVertexShader = `
attribute vec4 paint;
uniform float scale;
varying vec4 shade;
void main() {
  shade = paint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = scale * paint.a;
}`;

const kFragmentShader = `
const float kLoaded = 10.0;
varying vec4 shade;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  bool open = shade.a > kLoaded;
  float reach = open ? abs(at.x) + abs(at.y) : length(at);
  if (reach > 1.0) discard;
  float rim = open ? 0.62 : 0.72;
  gl_FragColor = vec4(reach > rim ? vec3(0.1) : shade.rgb, reach > rim ? 0.75 : 1.0);
}`;

export class ContactCloud {
  constructor() {
    const geometry = new BufferGeometry();
    this.points_ = new BufferAttribute(new Float32Array(3 * kMost), 3).setUsage(DynamicDrawUsage);
    this.paint_ = new BufferAttribute(new Float32Array(4 * kMost), 4).setUsage(DynamicDrawUsage);
    geometry.setAttribute('position', this.points_);
    geometry.setAttribute('paint', this.paint_);
    geometry.setDrawRange(0, 0);
    const material = new ShaderMaterial({ vertexShader: kVertexShader, fragmentShader: kFragmentShader, uniforms: { scale: { value: 1 } }, transparent: true, depthTest: false, depthWrite: false });
    this.object = new Points(geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 1;
    this.shown = { contacts: 0, open: 0 };
  }

  setPixelRatio(ratio) {
    this.object.material.uniforms.scale.value = ratio;
  }

  /// Shows rows of contacts, and counts them in `shown`; null for none. `leafErrors` has the greatest error of a leaf for each body.
  show(rows, leafErrors = []) {
    const count = Math.min(kMost, (rows?.length ?? 0) / kContactNumbers);
    this.shown = { contacts: count, open: 0 };
    for (let k = 0; k < count; ++k) {
      const at = kContactNumbers * k;
      // An error beyond that of both trees' leaves: refinement ended before them. Ground and walls have none.
      const isOpen = rows[at + 7] > kRounding * ((leafErrors[rows[at + 8]] ?? 0) + (leafErrors[rows[at + 9]] ?? 0));
      this.shown.open += isOpen;
      this.points_.array.set(rows.subarray(at, at + 3), 3 * k);
      this.paint_.array.set(errorColor(rows[at + 7] / kGreatestShown), 4 * k);
      this.paint_.array[4 * k + 3] = isOpen ? kOpen : rows[at + 10] > 0 ? kLoaded : kFree;
    }
    this.points_.needsUpdate = this.paint_.needsUpdate = true;
    this.object.geometry.setDrawRange(0, count);
  }
}

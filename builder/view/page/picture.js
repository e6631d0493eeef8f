// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a picture is made: mesh and spheres each into an image with depth, both laid over each other, and while nothing
// moves the mean of several such samples, each shifted by a part of a pixel.
import {
  BufferAttribute,
  BufferGeometry,
  DepthTexture,
  GLSL3,
  HalfFloatType,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  Scene,
  UnsignedIntType,
  Vector2,
  Vector3,
  WebGLRenderTarget,
  WebGLRenderer,
} from 'three';
import blendFragment from './blend.frag.glsl';
import { kAlarmColor, kAlarmLinkColor, kErrorColors, kPlainColor } from './colors.js';
import composeFragment from './compose.frag.glsl';
import shading from './shading.glsl';
import showFragment from './show.frag.glsl';
import wholeVertex from './whole.vert.glsl';

const kSamples = 24; // of a picture at rest: edges have no steps left, and hollows no grain
const kTaps = 10; // a layer and sample, of the light in hollows
const kReach = 0.045; // of that light, of the size of the scene
// What is drawn while the view turns, best first: a machine that is too slow for one gets the next.
const kPaces = [
  { share: 1, taps: kTaps },
  { share: 1, taps: 0 },
  { share: 0.6, taps: 0 },
  { share: 0.4, taps: 0 },
  { share: 0.3, taps: 0 },
];
const kSlowFrame = 40; // milliseconds: below 25 a second, turning is no longer smooth
const kSlowFrames = 4; // until the next pace; one that takes n times as long counts n times

function halton(index, base) {
  let value = 0;
  for (let share = 1 / base; index > 0; index = Math.floor(index / base), share /= base) value += share * (index % base);
  return value;
}

function wholePass(fragmentShader, uniforms) {
  const geometry = new BufferGeometry();
  geometry.setIndex(new BufferAttribute(new Uint16Array([0, 1, 2]), 1));
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: wholeVertex,
    fragmentShader,
    depthTest: false,
    depthWrite: false,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }])),
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  const scene = new Scene();
  scene.add(mesh);
  return { scene, uniforms: material.uniforms };
}

function layerTarget() {
  const depthTexture = new DepthTexture(1, 1, UnsignedIntType);
  return new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter, depthTexture });
}

export class Picture {
  /// Throws where the browser has no WebGL 2.
  constructor(canvas, camera) {
    this.renderer_ = new WebGLRenderer({ canvas, antialias: false, alpha: false, depth: false });
    this.renderer_.autoClear = false;
    this.renderer_.setClearColor(0, 0);
    this.renderer_.outputColorSpace = 'srgb-linear'; // the shaders write what is shown
    this.renderer_.extensions.get('EXT_conservative_depth');
    const floats = this.renderer_.extensions.get('EXT_color_buffer_float') || this.renderer_.extensions.get('EXT_color_buffer_half_float');
    this.canAdd_ = floats !== null;
    this.camera_ = camera;
    this.solids = new Scene();
    this.spheres = new Scene();
    this.rings = new Scene();
    for (const scene of [this.solids, this.spheres, this.rings]) scene.matrixWorldAutoUpdate = true;
    this.makeTargets();
    this.makePasses();
    this.ahead_ = new Vector3();
    this.pace_ = 0;
    this.samples_ = 0;
    this.slow_ = 0;
  }

  makeTargets() {
    this.layers_ = { solid: layerTarget(), spheres: layerTarget() };
    const plain = { depthBuffer: false, minFilter: NearestFilter, magFilter: NearestFilter };
    this.sample_ = new WebGLRenderTarget(1, 1, plain);
    const type = this.canAdd_ ? { type: HalfFloatType } : {};
    this.means_ = [0, 1].map(() => new WebGLRenderTarget(1, 1, { ...plain, ...type, minFilter: 1006, magFilter: 1006 }));
    this.share_ = 0;
  }

  makePasses() {
    const { solid, spheres } = this.layers_;
    this.compose_ = wholePass(composeFragment.replace('vec4 sphereAt', `${shading}\nvec4 sphereAt`), {
      solidColor: solid.texture,
      solidDepth: solid.depthTexture,
      sphereName: spheres.texture,
      sphereDepth: spheres.depthTexture,
      balls: null,
      looks: null,
      ramp: kErrorColors.map((c) => new Vector3(...c)),
      alarm: new Vector3(...kAlarmColor),
      alarmLink: new Vector3(...kAlarmLinkColor),
      plain: new Vector3(...kPlainColor),
      size: new Vector2(),
      veil: 1,
      chosenVeil: 1,
      reach: kReach,
      taps: kTaps,
      turn: 0,
      above: new Vector3(),
      below: new Vector3(),
    });
    this.blend_ = wholePass(blendFragment, { before: null, now: this.sample_.texture, weight: 1 });
    this.show_ = wholePass(showFragment, { picture: null });
  }

  /// The canvas has this size, in CSS pixels.
  resize(width, height, pixelRatio) {
    this.size_ = { width, height, pixelRatio };
    this.renderer_.setPixelRatio(pixelRatio);
    this.renderer_.setSize(width, height, false);
    this.camera_.aspect = width / height;
    this.share_ = 0;
    this.restart();
  }

  setGround(above, below) {
    this.compose_.uniforms.above.value.set(...above);
    this.compose_.uniforms.below.value.set(...below);
  }

  /// The spheres whose numbers the second layer will hold.
  setCloud(cloud) {
    this.cloud_ = cloud;
    this.compose_.uniforms.balls.value = cloud.balls;
    this.compose_.uniforms.looks.value = cloud.looks;
  }

  /// Which of the cloud's spheres is drawn at a place, from 0 to 1 rightwards and upwards; null for none.
  drawnAt(x, y) {
    const { width, height } = this.layers_.spheres;
    const [red, green, blue, alpha] = this.pixelOf(this.layers_.spheres, Math.floor(x * width), Math.floor(y * height));
    return alpha === 255 && this.spheres.visible ? red | (green << 8) | (blue << 16) : null;
  }

  pixelOf(target, x, y) {
    const pixel = new Uint8Array(4);
    this.renderer_.readRenderTargetPixels(target, x, y, 1, 1, pixel);
    return pixel;
  }

  setVeils(veil, chosenVeil) {
    this.compose_.uniforms.veil.value = veil;
    this.compose_.uniforms.chosenVeil.value = chosenVeil;
  }

  /// Forgets the samples: what is shown has changed.
  restart() {
    this.samples_ = 0;
  }

  get isFinished() {
    return this.samples_ >= (this.canAdd_ ? kSamples : 1);
  }

  /// Pixels of what is drawn while the view turns, and the light in hollows or none.
  get pace() {
    const { share, taps } = kPaces[this.pace_];
    return { share, taps, width: Math.round(this.size_.width * this.size_.pixelRatio * share), height: Math.round(this.size_.height * this.size_.pixelRatio * share) };
  }

  /// Notes how long a frame took while the view turned, in milliseconds.
  noteFrame(milliseconds) {
    this.slow_ += milliseconds > kSlowFrame ? Math.floor(milliseconds / kSlowFrame) : -1;
    this.slow_ = Math.max(0, this.slow_);
    if (this.slow_ < kSlowFrames || this.pace_ === kPaces.length - 1) return;
    ++this.pace_;
    this.slow_ = 0;
  }

  useShare(share) {
    if (share === this.share_) return;
    this.share_ = share;
    const { width, height, pixelRatio } = this.size_;
    const [w, h] = [width, height].map((n) => Math.max(1, Math.round(n * pixelRatio * share)));
    for (const target of [this.layers_.solid, this.layers_.spheres, this.sample_, ...this.means_]) target.setSize(w, h);
    this.compose_.uniforms.size.value.set(w, h);
  }

  /// Draws the next sample, or, while the view moves, a picture of one.
  draw(isMoving) {
    const pace = isMoving ? kPaces[this.pace_] : kPaces[0];
    if (isMoving || this.share_ !== pace.share) this.restart();
    this.useShare(pace.share);
    this.drawSample(isMoving ? 0 : this.samples_, pace.taps);
    let shown = this.sample_;
    if (!isMoving && this.canAdd_) {
      const [before, after] = this.means_;
      this.blend_.uniforms.before.value = before.texture;
      this.blend_.uniforms.weight.value = 1 / (this.samples_ + 1);
      this.render(this.blend_.scene, after);
      this.means_.reverse();
      shown = after;
    }
    this.show_.uniforms.picture.value = shown.texture;
    this.render(this.show_.scene, null);
    if (!isMoving) ++this.samples_;
  }

  drawSample(index, taps) {
    const { camera_: camera, compose_: compose } = this;
    const { x, y } = compose.uniforms.size.value;
    camera.updateProjectionMatrix();
    camera.projectionMatrix.elements[8] += ((index === 0 ? 0.5 : halton(index, 2)) - 0.5) * (2 / x);
    camera.projectionMatrix.elements[9] += ((index === 0 ? 0.5 : halton(index, 3)) - 0.5) * (2 / y);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    compose.uniforms.taps.value = taps;
    compose.uniforms.turn.value = 2.39996 * index;
    if (index === 0) this.cloud_?.sort(camera.getWorldDirection(this.ahead_));
    this.render(this.solids, this.layers_.solid);
    this.render(this.spheres, this.layers_.spheres);
    this.render(compose.scene, this.sample_);
    this.render(this.rings, this.sample_, false);
  }

  render(scene, target, isCleared = true) {
    this.renderer_.setRenderTarget(target);
    if (isCleared) this.renderer_.clear();
    this.renderer_.render(scene, this.camera_);
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture: light, ground, camera, and when it is drawn.
import {
  BoxGeometry, Color, DirectionalLight, EdgesGeometry, Fog, HemisphereLight, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, Raycaster,
  Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { onThemeChange, themeColor } from './colors.js';

const kSlowFrame = 28; // ms; slower ones than this, and the picture gets simpler
const kJudged = 20; // frames that are judged together, or fewer where they take longer than this:
const kJudgedTime = 1500; // ms
const kPixelRatios = [0.5, 0.75, 1, 2]; // at most, by quality; shadows only at the last
const kShownHeight = 2.2; // m, of the pit's glass

/// Whether this browser draws without a graphics card.
function drawsInSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const told = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = told ? String(gl.getParameter(told.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function rendererOf(canvas, antialias) {
  try {
    return new WebGLRenderer({ canvas, antialias });
  } catch {
    throw new Error('This browser draws nothing with WebGL 2; switch on its hardware acceleration, or take another browser.');
  }
}

export class Stage {
  constructor(canvas) {
    this.canvas_ = canvas;
    const isSlow = drawsInSoftware();
    this.renderer_ = rendererOf(canvas, !isSlow);
    this.renderer_.shadowMap.enabled = !isSlow;
    this.scene_ = new Scene();
    this.camera_ = new PerspectiveCamera(38, 1, 0.1, 400);
    this.controls_ = new OrbitControls(this.camera_, canvas);
    this.controls_.maxPolarAngle = 1.54;
    this.controls_.enableDamping = false;
    this.controls_.addEventListener('change', () => this.change());
    this.quality_ = isSlow ? 2 : 3;
    this.times_ = [];
    this.hasChanged_ = true;
    this.addLight();
    this.addGround();
    this.applyTheme();
    onThemeChange(() => this.applyTheme());
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  get camera() {
    return this.camera_;
  }

  get controls() {
    return this.controls_;
  }

  get quality() {
    return this.quality_;
  }

  addLight() {
    this.sun_ = new DirectionalLight('#fff4e0', 2.3);
    this.sun_.castShadow = true;
    this.sun_.shadow.mapSize.set(1024, 1024);
    this.sun_.shadow.bias = -0.002;
    this.sun_.shadow.normalBias = 0.02;
    this.scene_.add(this.sun_, this.sun_.target, new HemisphereLight('#ffffff', '#6f675c', 1.35));
  }

  addGround() {
    const plane = new PlaneGeometry(1, 1).rotateX(-Math.PI / 2);
    this.ground_ = new Mesh(plane, new MeshLambertMaterial());
    this.floor_ = new Mesh(plane, new MeshLambertMaterial());
    this.ground_.receiveShadow = this.floor_.receiveShadow = true;
    this.glass_ = new LineSegments(new EdgesGeometry(new BoxGeometry(1, 1, 1)), new LineBasicMaterial({ transparent: true, opacity: 0.35 }));
    this.scene_.add(this.ground_, this.floor_, this.glass_);
  }

  add(object) {
    this.scene_.add(object);
    this.change();
  }

  remove(object) {
    this.scene_.remove(object);
    this.change();
  }

  /// Something looks different now: the next picture is drawn, else it is not.
  change() {
    this.hasChanged_ = true;
  }

  get hasChanged() {
    return this.hasChanged_;
  }

  applyTheme() {
    const [above, ground] = [themeColor('above'), themeColor('ground')];
    this.scene_.background = new Color(above);
    this.scene_.fog = new Fog(above, 40, 140);
    this.ground_.material.color.set(ground);
    this.floor_.material.color.set(themeColor('floor'));
    this.glass_.material.color.set(themeColor('ink'));
    this.change();
  }

  /// Frames a pit: its glass, its shadows, and the whole of it from a corner.
  showPit({ half }) {
    this.glass_.visible = this.floor_.visible = true;
    this.floor_.scale.set(2 * half, 1, 2 * half);
    this.ground_.scale.set(600, 1, 600);
    this.ground_.position.set(0, -0.02, 0);
    this.glass_.scale.set(2 * half, kShownHeight, 2 * half);
    this.glass_.position.y = kShownHeight / 2;
    this.shade(new Vector3(), 2.2 * half + 2);
    this.fog(40, 140);
    this.subject_ = { middle: new Vector3(0, 0.36 * half, 0), radius: 1.36 * half + 0.3 };
    this.frame();
  }

  /// Frames a box in the open, as trajectories have it.
  showBox(low, high) {
    this.glass_.visible = this.floor_.visible = false;
    const middle = low.clone().add(high).multiplyScalar(0.5);
    const radius = 0.5 * low.distanceTo(high);
    this.ground_.scale.set(60 * radius, 1, 60 * radius);
    this.ground_.position.set(middle.x, low.y - 0.5, middle.z);
    this.shade(middle, radius);
    this.fog(6 * radius, 20 * radius);
    this.subject_ = { middle, radius: 0.9 * radius };
    this.frame();
  }

  fog(near, far) {
    this.scene_.fog.near = near;
    this.scene_.fog.far = far;
    this.camera_.far = 1.5 * far;
  }

  shade(middle, reach) {
    const { camera } = this.sun_.shadow;
    this.sun_.position.copy(middle).add(new Vector3(0.5, 1.6, 0.7).multiplyScalar(reach));
    this.sun_.target.position.copy(middle);
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 5 * reach });
    camera.updateProjectionMatrix();
  }

  /// Looks at the whole subject.
  frame() {
    const { middle, radius } = this.subject_;
    const across = Math.min(1, this.camera_.aspect);
    const distance = radius / Math.sin((this.camera_.fov * Math.PI) / 360) / across;
    this.controls_.target.copy(middle);
    this.camera_.position.set(0.62, 0.58, 0.95).normalize().multiplyScalar(distance).add(middle);
    this.camera_.updateProjectionMatrix();
    this.controls_.update();
  }

  /// Turns the eye around the subject by angles in radians, and goes nearer by a factor.
  move(aside, up, nearer) {
    const offset = this.camera_.position.clone().sub(this.controls_.target);
    offset.applyAxisAngle(new Vector3(0, 1, 0), aside);
    const axis = new Vector3(0, 1, 0).cross(offset).normalize();
    const tilted = offset.clone().applyAxisAngle(axis, -up);
    if (tilted.y > 0.02 * tilted.length() && tilted.y < 0.99 * tilted.length()) offset.copy(tilted);
    this.camera_.position.copy(this.controls_.target).add(offset.multiplyScalar(nearer));
    this.controls_.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas_;
    if (width === 0 || height === 0) return;
    this.renderer_.setPixelRatio(Math.min(devicePixelRatio, kPixelRatios[this.quality_]));
    this.change();
    this.renderer_.setSize(width, height, false);
    this.camera_.aspect = width / height;
    this.camera_.updateProjectionMatrix();
    this.onResize?.(this.renderer_.getPixelRatio());
  }

  /// Draws. With `isWaiting`, returns when all pixels are there, for measuring; returns milliseconds.
  draw(isWaiting = false) {
    const start = performance.now();
    this.hasChanged_ = false;
    this.renderer_.render(this.scene_, this.camera_);
    if (isWaiting) {
      const gl = this.renderer_.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
    return performance.now() - start;
  }

  /// Takes the time between two frames; machines that are too slow for shadows or all pixels do without.
  noteFrame(milliseconds) {
    if (this.quality_ === 0) return;
    this.times_.push(milliseconds);
    const whole = this.times_.reduce((sum, time) => sum + time, 0);
    if (this.times_.length < kJudged && (this.times_.length < 3 || whole < kJudgedTime)) return;
    const median = this.times_.sort((a, b) => a - b)[this.times_.length >> 1];
    this.times_ = [];
    if (median > kSlowFrame) this.setQuality(this.quality_ - 1);
  }

  setQuality(quality) {
    this.quality_ = quality;
    this.sun_.castShadow = quality === 3;
    this.resize();
  }

  /// The ray through a place of the page, in CSS pixels.
  rayThrough(clientX, clientY) {
    const box = this.canvas_.getBoundingClientRect();
    const at = new Vector2((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
    const raycaster = new Raycaster();
    raycaster.setFromCamera(at, this.camera_);
    return raycaster;
  }

  /// Where a point is on the page, in CSS pixels.
  onPage(point) {
    const box = this.canvas_.getBoundingClientRect();
    const { x, y } = point.clone().project(this.camera_);
    return { x: box.left + (0.5 + 0.5 * x) * box.width, y: box.top + (0.5 - 0.5 * y) * box.height };
  }
}

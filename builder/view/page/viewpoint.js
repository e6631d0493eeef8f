// SPDX-License-Identifier: GPL-3.0-or-later
//
// From where one looks: a camera that goes around the scene, whose size is 1.
import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const kFieldOfView = 28; // degrees, of the smaller side: little perspective, as a product is photographed
const kFlight = 350; // milliseconds to the whole view
const kTilt = 0.3; // radians the eye stands above the middle
const kAside = 0.6; // radians it stands beside the front

export class Viewpoint {
  /// Calls `onMove` after every change.
  constructor(canvas, onMove) {
    this.camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 20);
    this.controls_ = new OrbitControls(this.camera, canvas);
    this.controls_.enableDamping = false;
    this.controls_.minDistance = 0.15;
    this.controls_.maxDistance = 8;
    this.controls_.addEventListener('change', onMove);
    this.onMove_ = onMove;
    this.up_ = 'y';
    this.middle_ = new Vector3();
    this.radius_ = 0.5;
    this.flight_ = 0;
  }

  /// What the whole view holds: a ball.
  setSubject(middle, radius) {
    this.middle_.set(...middle);
    this.radius_ = radius;
  }

  get up() {
    return this.up_;
  }

  setUp(axis) {
    this.up_ = axis;
    this.camera.up.set(0, axis === 'y' ? 1 : 0, axis === 'z' ? 1 : 0);
    this.controls_.dispose();
    const canvas = this.controls_.domElement;
    const { onMove_ } = this;
    this.controls_ = new OrbitControls(this.camera, canvas);
    this.controls_.minDistance = 0.15;
    this.controls_.maxDistance = 8;
    this.controls_.addEventListener('change', onMove_);
    this.controls_.target.copy(this.middle_);
  }

  wholeView() {
    const across = Math.min(1, this.camera.aspect);
    this.camera.fov = (2 * 180 * Math.atan(Math.tan((kFieldOfView * Math.PI) / 360) / across)) / Math.PI;
    const distance = this.radius_ / Math.sin((kFieldOfView * Math.PI) / 360);
    const [aside, ahead, up] = [Math.sin(kAside) * Math.cos(kTilt), Math.cos(kAside) * Math.cos(kTilt), Math.sin(kTilt)];
    const direction = this.up_ === 'y' ? [aside, up, ahead] : [aside, -ahead, up];
    return new Vector3(...direction).multiplyScalar(distance).add(this.middle_);
  }

  /// Looks at all of it from where a picture of it is best; at once, or in a short flight.
  frame(isAtOnce) {
    const [from, to] = [this.camera.position.clone(), this.wholeView()];
    const [target, start] = [this.controls_.target.clone(), performance.now()];
    const flight = ++this.flight_;
    const step = () => {
      if (flight !== this.flight_) return;
      const t = isAtOnce ? 1 : Math.min(1, (performance.now() - start) / kFlight);
      const eased = t * t * (3 - 2 * t);
      this.camera.position.lerpVectors(from, to, eased);
      this.controls_.target.lerpVectors(target, this.middle_, eased);
      this.controls_.update();
      this.onMove_();
      if (t < 1) requestAnimationFrame(step);
    };
    step();
  }

  /// Turns the eye around the scene by an angle in radians.
  turn(angle) {
    const offset = this.camera.position.clone().sub(this.controls_.target);
    offset.applyAxisAngle(this.camera.up, angle);
    this.camera.position.copy(this.controls_.target).add(offset);
    this.controls_.update();
    this.onMove_();
  }

  /// The ray through a point of the canvas, from -1 to 1 in both directions, upwards.
  rayThrough(x, y) {
    const eye = this.camera.position;
    this.camera.updateMatrixWorld();
    this.camera.updateProjectionMatrix();
    const direction = new Vector3(x, y, 0.5).unproject(this.camera).sub(eye).normalize();
    return { eye: eye.toArray(), direction: direction.toArray() };
  }

  /// Where a point is on the canvas, from -1 to 1 in both directions, upwards.
  onCanvas(point) {
    this.camera.updateMatrixWorld();
    this.camera.updateProjectionMatrix();
    const { x, y } = new Vector3(...point).project(this.camera);
    return { x, y };
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// A hand that takes a body and pulls it, by pointer or by keys.
import { BufferGeometry, Line, LineBasicMaterial, Plane, Vector3 } from 'three';

const kKeyStep = 0.2; // m a key press moves the hand
const kLift = 0.8; // m, how high keys lift a body when they take it

export class Hand {
  /// `pull(body, point, target)` tells the engine; point is null when the hand lets go.
  constructor(stage, canvas, pull) {
    this.stage_ = stage;
    this.pull_ = pull;
    this.cloud_ = null;
    this.chosen_ = null;
    this.grip_ = null;
    this.string_ = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]), new LineBasicMaterial({ color: '#f08a24', depthTest: false }));
    this.string_.frustumCulled = false;
    this.string_.visible = false;
    stage.add(this.string_);
    // Before the camera's own listeners: a finger on a body takes the body, else it turns the view.
    canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    addEventListener('pointermove', (event) => this.moveTo(event));
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, (event) => this.up(event));
  }

  /// Called when another body is chosen, taken or let go.
  onChange = null;

  get chosen() {
    return this.chosen_;
  }

  get holds() {
    return this.grip_ !== null;
  }

  setCloud(cloud) {
    this.release();
    this.cloud_ = cloud;
    this.choose(null);
  }

  choose(body) {
    this.chosen_ = body;
    this.cloud_?.mark(body, this.holds);
    this.onChange?.();
  }

  down(event) {
    if (!event.isPrimary || event.button !== 0 || !this.cloud_?.poses) return;
    const hit = this.cloud_.hit(this.stage_.rayThrough(event.clientX, event.clientY));
    if (!hit) return;
    const plane = new Plane().setFromNormalAndCoplanarPoint(this.stage_.camera.getWorldDirection(new Vector3()), hit.place);
    this.stage_.controls.enabled = false;
    this.take(hit.body, hit.point, hit.place, { plane, pointer: event.pointerId });
  }

  take(body, point, target, how = {}) {
    this.release();
    this.grip_ = { body, point, target: target.clone(), ...how };
    this.choose(body);
    this.tell();
  }

  moveTo(event) {
    if (!this.grip_?.plane || event.pointerId !== this.grip_.pointer) return;
    const place = this.stage_.rayThrough(event.clientX, event.clientY).ray.intersectPlane(this.grip_.plane, new Vector3());
    if (!place) return;
    this.grip_.target.copy(place).setY(Math.max(place.y, 0));
    this.tell();
  }

  up(event) {
    if (this.grip_?.pointer !== event.pointerId) return;
    this.release();
  }

  release() {
    if (!this.grip_) return;
    this.pull_(this.grip_.body, null);
    this.grip_ = null;
    this.stage_.controls.enabled = true;
    this.string_.visible = false;
    this.choose(this.chosen_);
  }

  tell() {
    this.pull_(this.grip_.body, this.grip_.point.toArray(), this.grip_.target.toArray());
  }

  /// Takes the chosen body by its middle and lifts it, or lets it go.
  toggle() {
    if (this.grip_) return this.release();
    if (this.chosen_ === null || !this.cloud_?.poses) return undefined;
    const middle = this.cloud_.middleOf(this.chosen_);
    return this.take(this.chosen_, new Vector3(), middle.setY(middle.y + kLift));
  }

  /// Moves a held body, seen from the camera: aside, up and away, each -1, 0 or 1.
  nudge(aside, up, away) {
    const ahead = this.stage_.camera.getWorldDirection(new Vector3()).setY(0).normalize();
    const right = ahead.clone().cross(new Vector3(0, 1, 0));
    this.grip_.target.addScaledVector(right, kKeyStep * aside).addScaledVector(ahead, kKeyStep * away);
    this.grip_.target.y = Math.max(0, this.grip_.target.y + kKeyStep * up);
    this.tell();
  }

  /// Chooses the next body, or the one before.
  next(step) {
    const { count } = this.cloud_ ?? { count: 0 };
    if (count === 0) return;
    this.release();
    this.choose(this.chosen_ === null ? (step > 0 ? 0 : count - 1) : (this.chosen_ + step + count) % count);
  }

  /// Puts the string from the body to the hand. Returns whether there is one.
  update() {
    this.string_.visible = this.holds;
    if (!this.grip_) return false;
    const places = this.string_.geometry.attributes.position;
    places.setXYZ(0, ...this.cloud_.inWorld(this.grip_.body, this.grip_.point).toArray());
    places.setXYZ(1, ...this.grip_.target.toArray());
    places.needsUpdate = true;
    return true;
  }
}

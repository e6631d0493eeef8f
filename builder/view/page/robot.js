// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links in their places, moved by joints. A single body is a robot of one link.
import { allPositions, clamped, defaultPosition, isActive, linkPoses, parentsFirst, placed } from './joints.js';
import { Overlaps } from './overlaps.js';

export class Robot {
  constructor({ links, joints, whole, ignored }) {
    this.links_ = links;
    this.joints = joints;
    this.whole_ = whole;
    // What the picture's origin is in the root's frame: float32 keeps what lies near it.
    this.base = links.length === 1 ? links[0].origin : [0, 0, 0];
    this.order_ = parentsFirst(links.length, joints);
    this.overlaps_ = new Overlaps(whole, links, ignored);
    this.positions_ = joints.map(defaultPosition);
    this.place();
  }

  /// Numbers of the joints that have a position of their own.
  get active() {
    return this.joints.flatMap((joint, j) => (isActive(joint) ? [j] : []));
  }

  positionOf(j) {
    return this.positions_[j];
  }

  /// Moves a joint, within its limits.
  move(j, position) {
    this.positions_[j] = clamped(this.joints[j], position);
    this.place();
  }

  rest() {
    this.positions_ = this.joints.map(defaultPosition);
    this.place();
  }

  place() {
    const { whole_: whole, links_: links } = this;
    this.poses = linkPoses(links.length, this.joints, this.order_, this.positions_).map(({ rotation, translation }) => ({
      rotation,
      translation: translation.map((c, k) => c - this.base[k]),
    }));
    for (let node = 0; node < whole.count; ++node) {
      const { origin, centers } = links[whole.owner[node]];
      const at = 3 * whole.local[node];
      whole.centers.set(placed(this.poses[whole.owner[node]], origin.map((c, k) => c + centers[at + k])), 3 * node);
    }
    this.overlapping = this.overlaps_.find();
  }

  /// Links that overlap another.
  get alarmed() {
    return new Set(this.overlapping.flat());
  }

  get state() {
    const names = this.links_.map(({ name }) => name);
    const positions = allPositions(this.joints, this.positions_);
    return {
      joints: Object.fromEntries(this.joints.map(({ name }, j) => [name, positions[j]])),
      overlaps: this.overlapping.map((pair) => pair.map((link) => names[link])),
      poses: Object.fromEntries(this.poses.map((pose, link) => [names[link], pose])),
    };
  }
}

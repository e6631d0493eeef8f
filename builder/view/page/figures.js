// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is in the picture: the mesh of each link, the spheres of all, and outlines of the chosen one and its parent.
import { trianglesOf } from './scene.js';
import { Solid } from './solid.js';
import { Ring, SphereCloud } from './sphere_cloud.js';

export class Figures {
  /// Puts them into a picture. `unit` is the length of the file's unit there.
  constructor({ links, whole }, unit, picture) {
    this.links_ = links;
    this.whole_ = whole;
    this.solids_ = links.map((link) => (link.triangles.length > 0 ? new Solid(link, unit) : null));
    for (const solid of this.solids) picture.solids.add(solid.object);
    if (whole.count === 0) return;
    this.cloud_ = new SphereCloud(whole, unit);
    picture.spheres.add(this.cloud_.object);
    picture.setCloud(this.cloud_);
    this.parentRing_ = new Ring(whole, unit, { lineWidth: 1.6, haze: 0.22 });
    this.ring_ = new Ring(whole, unit, { lineWidth: 2.2, haze: 0 });
    picture.rings.add(this.parentRing_.object, this.ring_.object);
  }

  /// Those of links that have a mesh.
  get solids() {
    return this.solids_.filter((solid) => solid !== null);
  }

  get sphereCount() {
    return this.cloud_?.count ?? 0;
  }

  /// Meshes go where their links are; those of alarmed links turn red.
  place({ poses, alarmed }) {
    this.solids_.forEach((solid, link) => {
      solid?.place(poses[link]);
      solid?.setAlarm(alarmed.has(link));
    });
  }

  show(cut, greatest, chosen) {
    this.cloud_.show(cut, greatest, chosen);
    const parent = chosen === null ? null : this.whole_.parents[chosen];
    this.ring_.show(chosen);
    this.parentRing_.show(parent === chosen ? null : parent);
    this.solids_.forEach((solid, link) => {
      const isOwner = chosen !== null && this.whole_.owner[chosen] === link;
      solid?.mark(isOwner ? trianglesOf(this.links_[link], this.whole_.local[chosen]) : []);
    });
  }

  setWire(shown) {
    for (const solid of this.solids) solid.setWire(shown);
  }

  setColors(colors, pixelRatio) {
    for (const solid of this.solids) solid.setColors({ stone: colors.stone, mark: colors.mark, ink: colors.wire });
    this.ring_?.setInk(colors.ring, pixelRatio);
    this.parentRing_?.setInk(colors.parent, pixelRatio);
  }
}

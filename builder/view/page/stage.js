// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture on the page: what is in it, when it is drawn, and what is under the pointer.
import { firstSphereHit } from './pick.js';
import { Picture } from './picture.js';
import { trianglesOf } from './scene.js';
import { Solid } from './solid.js';
import { Ring, SphereCloud } from './sphere_cloud.js';
import { onThemeChange, themeColors, wantsLittleMotion } from './theme.js';
import { Viewpoint } from './viewpoint.js';

const kVeil = 0.62; // opacity of spheres over the mesh
const kVeilBesides = 0.34; // of those beside a chosen one
const kChosenVeil = 0.8;
const kRoom = 1.15; // how much larger than the mesh the whole view is: spheres stick out
const kRest = 160; // milliseconds after the last motion, until the picture is refined
const kMaxPixelRatio = 2;
const kClick = 5; // CSS pixels a pointer may move during a click

/// The middle and radius of the box around the vertices, or around the spheres where there is no mesh.
function subjectOf(link) {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  const { vertices } = link;
  for (let i = 0; i < vertices.length; ++i) {
    lower[i % 3] = Math.min(lower[i % 3], vertices[i]);
    upper[i % 3] = Math.max(upper[i % 3], vertices[i]);
  }
  const middle = lower.map((l, k) => (l + upper[k]) / 2);
  let radius = 0;
  for (let i = 0; i < vertices.length; i += 3)
    radius = Math.max(radius, Math.hypot(...middle.map((m, k) => vertices[i + k] - m)));
  return { middle, radius };
}

export class Stage {
  constructor(canvas, scene) {
    this.canvas_ = canvas;
    [this.link_] = scene.links;
    const { middle, radius } = subjectOf(this.link_);
    this.unit_ = 0.5 / radius;
    this.viewpoint_ = new Viewpoint(canvas, () => this.noteMotion());
    this.picture_ = new Picture(canvas, this.viewpoint_.camera);
    this.addObjects();
    this.cut_ = new Uint32Array();
    this.chosen_ = null;
    this.shown_ = { mesh: true, spheres: true, edges: true };
    this.lastMotion_ = -Infinity;
    this.lastFrame_ = null;
    this.hasMoved_ = false;
    this.isAsked_ = false;
    this.waiting_ = [];
    this.viewpoint_.setSubject(middle.map((m) => m * this.unit_), 0.5 * kRoom);
    this.listen();
    this.applyTheme();
    this.resize();
    this.viewpoint_.frame(true);
  }

  addObjects() {
    const { link_: link, unit_: unit } = this;
    this.solid_ = new Solid(link, unit);
    this.picture_.solids.add(this.solid_.object);
    if (link.count === 0) return;
    this.cloud_ = new SphereCloud(link, unit);
    this.picture_.spheres.add(this.cloud_.object);
    this.picture_.setCloud(this.cloud_);
    this.parentRing_ = new Ring(link, unit, { lineWidth: 1.6, haze: 0.22 });
    this.ring_ = new Ring(link, unit, { lineWidth: 2.2, haze: 0 });
    this.picture_.rings.add(this.parentRing_.object, this.ring_.object);
  }

  listen() {
    new ResizeObserver(() => this.resize()).observe(this.canvas_);
    onThemeChange(() => this.applyTheme());
    let down = null;
    this.canvas_.addEventListener('pointerdown', (e) => (down = e.isPrimary ? [e.clientX, e.clientY] : null));
    this.canvas_.addEventListener('pointerup', (e) => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < kClick) this.onClick?.(this.sphereAt(e));
      down = null;
    });
  }

  /// Called with the sphere that was clicked, or null.
  onClick = null;

  /// Called after each drawing.
  onDraw = null;

  sphereAt({ clientX, clientY }) {
    if (!this.cloud_ || !this.shown_.spheres) return null;
    const box = this.canvas_.getBoundingClientRect();
    const [x, y] = [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
    return firstSphereHit(this.link_, this.unit_, this.cut_, this.viewpoint_.rayThrough(2 * x - 1, 1 - 2 * y));
  }

  /// Where the middle of a sphere is on the page, and how far its upper end is above it, in CSS pixels.
  placeOf(node) {
    const box = this.canvas_.getBoundingClientRect();
    const centre = [0, 1, 2].map((k) => this.link_.centers[3 * node + k] * this.unit_);
    const camera = this.viewpoint_.camera;
    const up = camera.matrixWorld.elements.slice(4, 7);
    const top = centre.map((c, k) => c + up[k] * this.link_.radii[node] * this.unit_);
    const onPage = (point) => {
      const { x, y } = this.viewpoint_.onCanvas(point);
      return { x: box.left + (0.5 + 0.5 * x) * box.width, y: box.top + (0.5 - 0.5 * y) * box.height };
    };
    const at = onPage(centre);
    return { ...at, rise: at.y - onPage(top).y };
  }

  /// The sphere that is drawn at a place of the page, in CSS pixels; null for none.
  drawnAt(x, y) {
    const box = this.canvas_.getBoundingClientRect();
    const k = this.picture_.drawnAt((x - box.left) / box.width, 1 - (y - box.top) / box.height);
    return k === null ? null : this.cut_[k];
  }

  get state() {
    return {
      instances: this.cloud_ && this.shown_.spheres ? this.cloud_.count : 0,
      shown: { ...this.shown_ },
      eye: this.viewpoint_.camera.position.toArray().map((c, k) => this.link_.origin[k] + c / this.unit_),
      pace: this.picture_.pace,
    };
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas_;
    if (width === 0 || height === 0) return;
    this.pixelRatio_ = Math.min(devicePixelRatio, kMaxPixelRatio);
    this.picture_.resize(width, height, this.pixelRatio_);
    this.viewpoint_.wholeView(); // for the field of view
    this.applyTheme();
  }

  applyTheme() {
    const colors = themeColors();
    this.picture_.setGround(colors.above, colors.below);
    this.solid_.setColors({ stone: colors.stone, mark: colors.mark, ink: colors.wire });
    this.ring_?.setInk(colors.ring, this.pixelRatio_ ?? 1);
    this.parentRing_?.setInk(colors.parent, this.pixelRatio_ ?? 1);
    this.change();
  }

  /// Shows the spheres `cut`, coloured up to the error `greatest`; one of them, or none, chosen.
  show(cut, greatest, chosen) {
    this.cut_ = cut;
    this.chosen_ = chosen;
    this.cloud_.show(cut, greatest, chosen);
    const parent = chosen === null ? null : this.link_.parents[chosen];
    this.ring_.show(chosen);
    this.parentRing_.show(parent === chosen ? null : parent);
    this.solid_.mark(chosen === null ? [] : trianglesOf(this.link_, chosen));
    this.applyShown();
  }

  setShown(shown) {
    this.shown_ = { ...shown };
    this.applyShown();
  }

  applyShown() {
    const { mesh, spheres, edges } = this.shown_;
    this.picture_.solids.visible = mesh;
    this.picture_.spheres.visible = spheres;
    this.picture_.rings.visible = spheres;
    this.solid_.setWire(edges);
    const besides = this.chosen_ === null ? kVeil : kVeilBesides;
    this.picture_.setVeils(mesh ? besides : 1, mesh ? kChosenVeil : 1);
    this.change();
  }

  frame() {
    this.viewpoint_.frame(wantsLittleMotion());
  }

  get up() {
    return this.viewpoint_.up;
  }

  setUp(axis) {
    this.viewpoint_.setUp(axis);
    this.viewpoint_.frame(true);
  }

  /// Something looks different now, from the same place.
  change() {
    this.picture_.restart();
    this.ask();
  }

  noteMotion() {
    this.lastMotion_ = performance.now();
    this.hasMoved_ = true;
    this.ask();
  }

  ask() {
    if (this.isAsked_) return;
    this.isAsked_ = true;
    requestAnimationFrame((now) => this.drawFrame(now));
  }

  drawFrame(now) {
    this.isAsked_ = false;
    // A frame may take longer than a rest on a slow machine.
    const isMoving = this.hasMoved_ || performance.now() - this.lastMotion_ < kRest;
    this.hasMoved_ = false;
    if (isMoving && this.lastFrame_ !== null) this.picture_.noteFrame(now - this.lastFrame_);
    this.lastFrame_ = isMoving ? now : null;
    this.picture_.draw(isMoving);
    this.onDraw?.();
    if (isMoving || !this.picture_.isFinished) this.ask();
    else this.waiting_.splice(0).forEach((done) => done());
  }

  /// Fulfilled once the picture is as good as it gets.
  settled() {
    return new Promise((done) => {
      this.waiting_.push(done);
      this.ask();
    });
  }

  /// Turns the view for some seconds, and tells how many frames were drawn in the second half of them.
  orbit(seconds) {
    const start = performance.now();
    return new Promise((done) => {
      let [frames, from, last] = [0, null, start];
      const step = () => {
        const now = performance.now();
        if (now - start > 500 * seconds) {
          from ??= now;
          if (now > from) ++frames;
        }
        if (now - start > 1000 * seconds) return done({ frames, seconds: (now - from) / 1000, pace: this.picture_.pace });
        this.viewpoint_.turn(0.0008 * (now - last));
        last = now;
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    });
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture on the page: what is in it, when it is drawn, and what is under the pointer.
import { Figures } from './figures.js';
import { firstSphereHit } from './pick.js';
import { Picture } from './picture.js';
import { subjectOf } from './subject.js';
import { onThemeChange, themeColors, wantsLittleMotion } from './theme.js';
import { Viewpoint } from './viewpoint.js';

const kVeil = 0.62; // opacity of spheres over the mesh
const kVeilBesides = 0.34; // of those beside a chosen one
const kChosenVeil = 0.8;
const kRoom = 1.15; // how much larger than the mesh the whole view is: spheres stick out
const kRest = 160; // milliseconds after the last motion, until the picture is refined
const kMaxPixelRatio = 2;
const kClick = 5; // CSS pixels a pointer may move during a click

export class Stage {
  constructor(canvas, scene, robot) {
    this.canvas_ = canvas;
    this.scene_ = scene;
    this.robot_ = robot;
    this.unit_ = 0.5 / subjectOf(scene, robot.poses).radius;
    this.viewpoint_ = new Viewpoint(canvas, () => this.noteMotion());
    this.picture_ = new Picture(canvas, this.viewpoint_.camera);
    this.figures_ = new Figures(scene, this.unit_, this.picture_);
    this.shows_ = { cut: new Uint32Array(), greatest: 0, chosen: null, mesh: true, spheres: true, edges: true };
    this.lastMotion_ = -Infinity;
    this.lastFrame_ = null;
    this.hasMoved_ = false;
    this.isAsked_ = false;
    this.waiting_ = [];
    this.figures_.place(robot);
    this.takeSubject();
    this.listen();
    this.applyTheme();
    this.resize();
    if (scene.up !== this.up) this.setUp(scene.up);
    this.viewpoint_.frame(true);
  }

  /// The whole view is of the links as they stand now.
  takeSubject() {
    const { middle, radius } = subjectOf(this.scene_, this.robot_.poses);
    this.viewpoint_.setSubject(middle.map((m) => m * this.unit_), radius * this.unit_ * kRoom);
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
    if (!this.shows_.spheres) return null;
    const box = this.canvas_.getBoundingClientRect();
    const [x, y] = [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
    return firstSphereHit(this.scene_.whole, this.unit_, this.shows_.cut, this.viewpoint_.rayThrough(2 * x - 1, 1 - 2 * y));
  }

  /// Where the middle of a sphere is on the page, and how far its upper end is above it, in CSS pixels.
  placeOf(node) {
    const box = this.canvas_.getBoundingClientRect();
    const centre = [0, 1, 2].map((k) => this.scene_.whole.centers[3 * node + k] * this.unit_);
    const camera = this.viewpoint_.camera;
    const up = camera.matrixWorld.elements.slice(4, 7);
    const top = centre.map((c, k) => c + up[k] * this.scene_.whole.radii[node] * this.unit_);
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
    return k === null ? null : this.shows_.cut[k];
  }

  get state() {
    const { mesh, spheres, edges } = this.shows_;
    return {
      instances: spheres ? this.figures_.sphereCount : 0,
      shown: { mesh, spheres, edges },
      eye: this.viewpoint_.camera.position.toArray().map((c, k) => this.robot_.base[k] + c / this.unit_),
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
    this.figures_.setColors(colors, this.pixelRatio_ ?? 1);
    this.change();
  }

  /// Shows the spheres `cut`, coloured up to the error `greatest`; one of them, or none, chosen.
  show(cut, greatest, chosen) {
    Object.assign(this.shows_, { cut, greatest, chosen });
    this.figures_.show(cut, greatest, chosen);
    this.applyShown();
  }

  /// The links have moved.
  place() {
    const { cut, greatest, chosen } = this.shows_;
    this.figures_.place(this.robot_);
    if (cut.length > 0) this.figures_.show(cut, greatest, chosen);
    this.noteMotion();
  }

  setShown(shown) {
    Object.assign(this.shows_, shown);
    this.applyShown();
  }

  applyShown() {
    const { mesh, spheres, edges, chosen } = this.shows_;
    this.picture_.solids.visible = mesh;
    this.picture_.spheres.visible = spheres;
    this.picture_.rings.visible = spheres;
    this.figures_.setWire(edges);
    const besides = chosen === null ? kVeil : kVeilBesides;
    const isVeiled = mesh && this.figures_.solids.length > 0;
    this.picture_.setVeils(isVeiled ? besides : 1, isVeiled ? kChosenVeil : 1);
    this.change();
  }

  frame() {
    this.takeSubject();
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

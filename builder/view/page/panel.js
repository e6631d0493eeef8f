// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words and controls beside the picture, and what is chosen by them.
import { countText, percentText } from './colors.js';
import { listDetails } from './details.js';
import { factsText } from './facts.js';
import { placeLabels } from './labels.js';
import { drawLegend } from './legend.js';
import { tellOverlaps } from './notice.js';
import { levelCut, levelToBeginWith, worstOf } from './scene.js';

const byId = (id) => document.getElementById(id);

export class Panel {
  constructor(scene, stage, robot) {
    this.scene_ = scene;
    this.whole_ = scene.whole;
    this.stage_ = stage;
    this.robot_ = robot;
    this.level_ = levelToBeginWith(this.whole_);
    this.chosen_ = null;
    this.shown_ = { mesh: true, spheres: true, edges: true };
    document.body.classList.toggle('robot', scene.isRobot);
    byId('facts').textContent = factsText(scene);
    this.listen();
    if (this.hasSpheres) this.showLevels();
    byId('show-spheres').hidden = !this.hasSpheres;
    for (const name of ['mesh', 'edges']) byId(`show-${name}`).hidden = !scene.links.some(({ triangles }) => triangles.length > 0);
    byId('up-axis').textContent = stage.up;
    byId('keys').textContent = this.keysText();
    this.update();
    this.noteMotion();
  }

  get hasSpheres() {
    return this.whole_.count > 0;
  }

  get isTree() {
    return this.whole_.depth > 0;
  }

  get state() {
    return { level: this.level_, chosen: this.chosen_, levels: this.whole_.depth + 1, spheres: this.whole_.count };
  }

  showLevels() {
    const isPlain = [...this.whole_.errors].map(Number.isNaN);
    byId('legend-section').hidden = false;
    for (const part of ['worst', 'legend', 'meaning']) byId(part).hidden = !isPlain.includes(false);
    byId('plain').hidden = !isPlain.includes(true);
    if (!this.isTree) return;
    byId('level-section').hidden = false;
    byId('level').max = this.whole_.depth;
    for (let level = 0; level <= this.whole_.depth; ++level) {
      const tick = document.createElement('span');
      tick.textContent = level;
      byId('ticks').append(tick);
    }
  }

  keysText() {
    const keys = [];
    if (this.isTree) keys.push('arrows change the level');
    if (this.robot_.active.length > 0) keys.push('arrows and page keys move a joint', 'R rest position');
    if (this.hasSpheres) keys.push('click a sphere to ask it', 'W worst sphere', ...(this.isTree ? ['P its parent'] : []), 'Esc lets go');
    keys.push('drag to turn, wheel or pinch to come closer');
    const text = keys.join(', ');
    return `${text[0].toUpperCase()}${text.slice(1)}.`;
  }

  listen() {
    byId('level').addEventListener('input', (event) => this.setLevel(Number(event.target.value)));
    byId('worst').addEventListener('click', () => this.chooseWorst());
    byId('close').addEventListener('click', () => this.choose(null));
    for (const name of Object.keys(this.shown_)) byId(`show-${name}`).addEventListener('click', () => this.toggle(name));
    byId('frame').addEventListener('click', () => this.frame());
    byId('up').addEventListener('click', () => this.turnUp());
    this.stage_.onClick = (sphere) => this.choose(sphere);
    this.stage_.onDraw = () => placeLabels(this.scene_, this.stage_, this.shown_.spheres ? this.chosen_ : null);
  }

  stepLevel(step) {
    this.setLevel(this.level_ + step);
  }

  setLevel(level) {
    if (!this.hasSpheres || level < 0 || level > this.whole_.depth || level === this.level_) return;
    this.level_ = level;
    this.chosen_ = null;
    this.update();
  }

  /// Chooses a sphere, whose level is shown then, or none for null.
  choose(sphere) {
    if (sphere === this.chosen_) return;
    this.chosen_ = sphere;
    if (sphere !== null && !levelCut(this.whole_, this.level_).includes(sphere)) this.level_ = this.whole_.levels[sphere];
    if (sphere !== null && !this.shown_.spheres) this.toggle('spheres');
    this.update();
  }

  chooseWorst() {
    const worst = worstOf(this.whole_, levelCut(this.whole_, this.level_));
    if (worst !== null) this.choose(worst);
  }

  chooseParent() {
    if (this.chosen_ !== null) this.choose(this.whole_.parents[this.chosen_]);
  }

  toggle(name) {
    if (name === 'spheres' && !this.hasSpheres) return;
    this.shown_[name] = !this.shown_[name];
    byId(`show-${name}`).setAttribute('aria-pressed', this.shown_[name]);
    this.stage_.setShown(this.shown_);
    this.describePicture();
  }

  frame() {
    this.stage_.frame();
  }

  turnUp() {
    this.stage_.setUp(this.stage_.up === 'y' ? 'z' : 'y');
    byId('up-axis').textContent = this.stage_.up;
  }

  update() {
    if (this.hasSpheres) {
      const cut = levelCut(this.whole_, this.level_);
      const worst = worstOf(this.whole_, cut);
      const greatest = worst === null ? 0 : this.whole_.errors[worst];
      this.stage_.show(cut, greatest, this.chosen_);
      this.showLevel(cut, greatest);
      drawLegend(byId('legend'), this.scene_, cut, greatest);
      this.showChosen();
    }
    this.describePicture();
  }

  showLevel(cut, greatest) {
    byId('level').value = this.level_;
    byId('level').setAttribute('aria-valuetext', `Level ${this.level_}, ${countText(cut.length)} spheres`);
    byId('level').style.setProperty('--share', this.level_ / Math.max(1, this.whole_.depth));
    byId('level-number').textContent = this.level_;
    byId('sphere-count').textContent = countText(cut.length);
    const percent = document.createElement('small');
    percent.textContent = percentText(greatest / this.scene_.links[0].diagonal);
    byId('level-error').replaceChildren(`${this.scene_.length(greatest)} `, percent);
  }

  showChosen() {
    byId('selection').hidden = this.chosen_ === null;
    if (this.chosen_ === null) return;
    const number = this.scene_.isRobot ? this.whole_.local[this.chosen_] : this.chosen_;
    byId('selection-name').textContent = `${this.isTree ? 'Node' : 'Sphere'} ${number}`;
    listDetails(byId('details'), this.scene_, this.chosen_, (node) => this.choose(node));
    if (this.scene_.isRobot) byId('selection').scrollIntoView({ block: 'nearest' }); // joints may have been scrolled to
  }

  /// The links have moved.
  noteMotion() {
    byId('overlaps').hidden = !(this.scene_.isRobot && this.hasSpheres);
    tellOverlaps(byId('overlaps'), this.scene_.links, this.robot_.overlapping);
  }

  describePicture() {
    const { links, isRobot } = this.scene_;
    const parts = [];
    if (this.shown_.mesh) parts.push(isRobot ? `the meshes of ${links.length} links` : `the mesh ${links[0].name}`);
    if (this.hasSpheres && this.shown_.spheres) parts.push(`${countText(levelCut(this.whole_, this.level_).length)} spheres`);
    const of = isRobot && this.chosen_ !== null ? ` of ${links[this.whole_.owner[this.chosen_]].name}` : '';
    const chosen = this.chosen_ === null ? '' : `; sphere ${this.whole_.local[this.chosen_]}${of} is chosen`;
    byId('picture').setAttribute('aria-label', `${parts.join(' and ') || 'nothing'}${chosen}`);
  }
}

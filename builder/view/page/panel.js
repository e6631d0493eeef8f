// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words and controls beside the picture, and what is chosen by them.
import { countText, lengthText, percentText } from './colors.js';
import { listDetails } from './details.js';
import { drawLegend } from './legend.js';
import { levelCut, levelToBeginWith, worstOf } from './scene.js';

const byId = (id) => document.getElementById(id);

export class Panel {
  constructor(scene, stage) {
    [this.link_] = scene.links;
    this.stage_ = stage;
    this.level_ = levelToBeginWith(this.link_);
    this.chosen_ = null;
    this.shown_ = { mesh: true, spheres: true, edges: true };
    this.showFacts(scene);
    this.listen();
    if (this.hasSpheres) this.showLevels();
    byId('show-spheres').hidden = !this.hasSpheres;
    byId('keys').textContent = this.keysText();
    this.update();
  }

  get hasSpheres() {
    return this.link_.count > 0;
  }

  get isTree() {
    return this.link_.depth > 0;
  }

  get state() {
    return { level: this.level_, chosen: this.chosen_, levels: this.link_.depth + 1, spheres: this.link_.count };
  }

  showFacts({ facts, links }) {
    const [link] = links;
    const texts = [];
    if (link.count > 0) texts.push(`${countText(link.count)} spheres${this.isTree ? ` on ${link.depth + 1} levels` : ''}`);
    texts.push(`${countText(link.triangles.length / 3)} triangles`);
    texts.push(`diagonal ${lengthText(link.diagonal)}`);
    for (const [name, value] of facts) texts.push(`${name.toLowerCase()} ${value}`);
    byId('facts').textContent = texts.join(' · ');
  }

  showLevels() {
    byId('legend-section').hidden = false;
    if (!this.isTree) return;
    byId('level-section').hidden = false;
    byId('level').max = this.link_.depth;
    for (let level = 0; level <= this.link_.depth; ++level) {
      const tick = document.createElement('span');
      tick.textContent = level;
      byId('ticks').append(tick);
    }
  }

  keysText() {
    const keys = [];
    if (this.isTree) keys.push('arrows change the level');
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
    this.stage_.onDraw = () => this.placeLabels();
  }

  stepLevel(step) {
    this.setLevel(this.level_ + step);
  }

  setLevel(level) {
    if (!this.hasSpheres || level < 0 || level > this.link_.depth || level === this.level_) return;
    this.level_ = level;
    this.chosen_ = null;
    this.update();
  }

  /// Chooses a sphere, whose level is shown then, or none for null.
  choose(sphere) {
    if (sphere === this.chosen_) return;
    this.chosen_ = sphere;
    if (sphere !== null && !levelCut(this.link_, this.level_).includes(sphere)) this.level_ = this.link_.levels[sphere];
    if (sphere !== null && !this.shown_.spheres) this.toggle('spheres');
    this.update();
  }

  chooseWorst() {
    if (this.hasSpheres) this.choose(worstOf(this.link_, levelCut(this.link_, this.level_)));
  }

  chooseParent() {
    if (this.chosen_ !== null) this.choose(this.link_.parents[this.chosen_]);
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
      const cut = levelCut(this.link_, this.level_);
      const greatest = this.link_.errors[worstOf(this.link_, cut)];
      this.stage_.show(cut, greatest, this.chosen_);
      this.showLevel(cut, greatest);
      drawLegend(byId('legend'), this.link_, cut, greatest);
      this.showChosen();
    }
    this.describePicture();
  }

  showLevel(cut, greatest) {
    byId('level').value = this.level_;
    byId('level').setAttribute('aria-valuetext', `Level ${this.level_}, ${countText(cut.length)} spheres`);
    byId('level').style.setProperty('--share', this.level_ / Math.max(1, this.link_.depth));
    byId('level-number').textContent = this.level_;
    byId('sphere-count').textContent = countText(cut.length);
    const percent = document.createElement('small');
    percent.textContent = percentText(greatest / this.link_.diagonal);
    byId('level-error').replaceChildren(`${lengthText(greatest)} `, percent);
  }

  showChosen() {
    byId('selection').hidden = this.chosen_ === null;
    if (this.chosen_ === null) return;
    byId('selection-name').textContent = `${this.isTree ? 'Node' : 'Sphere'} ${this.chosen_}`;
    listDetails(byId('details'), this.link_, this.chosen_, (node) => this.choose(node));
  }

  describePicture() {
    const parts = [];
    if (this.shown_.mesh) parts.push(`the mesh ${this.link_.name}`);
    if (this.hasSpheres && this.shown_.spheres) parts.push(`${countText(levelCut(this.link_, this.level_).length)} spheres`);
    const chosen = this.chosen_ === null ? '' : `; sphere ${this.chosen_} is chosen`;
    byId('picture').setAttribute('aria-label', `${parts.join(' and ') || 'nothing'}${chosen}`);
  }

  placeLabels() {
    const parent = this.chosen_ === null ? null : this.link_.parents[this.chosen_];
    this.placeLabel(byId('chosen-label'), this.chosen_, (node) => `${node}`);
    this.placeLabel(byId('parent-label'), parent === this.chosen_ ? null : parent, (node) => `parent ${node}`);
  }

  placeLabel(label, node, text) {
    label.hidden = node === null || !this.shown_.spheres;
    if (label.hidden) return;
    const { x, y, rise } = this.stage_.placeOf(node);
    const box = label.parentElement.getBoundingClientRect();
    label.textContent = text(node);
    label.style.transform = `translate(${Math.round(x - box.left)}px, ${Math.round(Math.max(18, y - rise - box.top))}px)`;
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: joins controls, engine, picture and charts.
import { Group } from 'three';
import { BodyCloud } from './body_cloud.js';
import { errorGradient, kGreatestShown } from './colors.js';
import { ContactCloud } from './contact_cloud.js';
import { engineOf } from './engines.js';
import { Hand } from './hand.js';
import { listenToKeys } from './keys.js';
import { EngineLink } from './link.js';
import { complete, loadModels } from './models.js';
import { budgetOf, countText, makeSwitch, millisecondsText, Panel, part, refuse, shortText } from './panel.js';
import { Recorder } from './recording.js';
import { ReplayPanel } from './replay_panel.js';
import { startOf } from './scene_plan.js';
import { Stage } from './stage.js';
import { quantile, StripChart } from './strip_chart.js';

const kSeed = 1;
const kTold = 100; // ms between two changes of numbers and charts

class Page {
  constructor(loaded) {
    const models = (this.models_ = loaded.bodies);
    this.stage_ = new Stage(part('picture'));
    this.contacts_ = new ContactCloud();
    this.bodies_ = new Group();
    this.stage_.add(this.bodies_);
    this.stage_.add(this.contacts_.object);
    this.stage_.onResize = (ratio) => this.contacts_.setPixelRatio(ratio);
    this.stage_.resize();
    this.timeChart_ = new StripChart(part('time-chart'), { least: 1, text: (value) => `${value} ms` });
    this.workChart_ = new StripChart(part('work-chart'), { least: 1000, text: shortText });
    this.link_ = new EngineLink({ onScene: (scene) => this.begin(scene), onFrame: (frame) => this.take(frame), onFault: (message) => this.fail(message) });
    this.hand_ = new Hand(this.stage_, part('picture'), (index, point, target) => this.link_.tell('drag', { index, point, target }));
    this.hand_.onChange = () => {
      this.showStatus();
      this.stage_.change();
    };
    this.panel_ = new Panel(models, { onScene: () => this.drop(), onBudget: (budget) => this.setBudget(budget) });
    this.pause_ = makeSwitch('pause', (isPaused) => this.link_.tell('run', { running: !isPaused && !this.replay_?.isOn }));
    this.showContacts_ = makeSwitch('show-contacts', (isOn) => this.setContacts(isOn));
    this.replay_ = new ReplayPanel(this.stage_, loaded, () => this.recorder_, (isOn) => this.setReplaying(isOn));
    part('frame').addEventListener('click', () => this.stage_.frame());
    part('gradient').style.background = errorGradient();
    part('greatest').textContent = `${100 * kGreatestShown} % of the size`;
    listenToKeys(part('picture'), this.stage_, this.hand_);
    this.asleep_ = 0;
    this.waiting_ = null;
    this.isDrawing = true; // measurements look at physics alone, too
  }

  /// Drops the bodies of the panel's wish into a new world.
  async drop() {
    const { engine, body, count } = this.panel_.wish;
    const wanted = (this.wanted_ = {});
    refuse('');
    this.replay_.close();
    this.isLoading_ = true;
    part('status').textContent = `${engineOf(engine).label} is loading`;
    const used = body === 'mixed' ? this.models_ : this.models_.filter(({ name }) => name === body);
    const models = await Promise.all(used.map((model) => complete(model, engineOf(engine)))).catch((error) => void this.fail(error.message));
    if (!models || wanted !== this.wanted_) return; // another wish came meanwhile
    const { pit, bodies } = startOf({ count, models: models.map((_, index) => index), seed: kSeed });
    this.hand_.setCloud(null);
    this.showBodies(models, bodies, pit);
    this.link_.tell('budget', { budget: budgetOf() });
    this.link_.start(engine, { models, bodies, pit, seed: kSeed, isRunning: !this.pause_.isOn });
  }

  fail(message) {
    this.isLoading_ = false;
    refuse(message);
  }

  showBodies(models, bodies, pit) {
    this.cloud_?.free();
    this.bodies_.clear();
    const kinds = bodies.map(({ model }) => model);
    this.cloud_ = new BodyCloud(models, kinds);
    this.cloud_.place(Float32Array.from(bodies.flatMap(({ position, rotation }) => [...position, ...rotation])));
    this.bodies_.add(this.cloud_.object);
    this.contacts_.show(null);
    this.waiting_ = null; // a frame of the bodies before
    if (this.pit_ !== pit.half) this.stage_.showPit(pit);
    this.pit_ = pit.half;
    this.leafErrors_ = kinds.map((kind) => this.models_.find(({ name }) => name === models[kind].name).leafError);
    this.kinds_ = { models: models.map(({ name }) => name), kinds };
  }

  /// A world stands.
  begin({ engine, hasBudget }) {
    this.engine_ = engine;
    this.isLoading_ = false;
    this.hasBudget_ = hasBudget;
    this.timeChart_.clear();
    this.workChart_.clear();
    this.panel_.setHasBudget(hasBudget);
    this.setBudget(budgetOf());
    this.recorder_ = new Recorder(`${engine.name} ${engine.version}`, this.kinds_.models, this.kinds_.kinds);
    this.hand_.setCloud(this.cloud_);
    this.step_ = 0;
    this.asleep_ = 0;
    this.showStatus();
  }

  setBudget(budget) {
    this.link_.tell('budget', { budget });
    this.timeChart_.limit = this.hasBudget_ && budget.microseconds ? budget.microseconds / 1000 : null;
    this.workChart_.limit = this.hasBudget_ && budget.operations ? budget.operations : null;
  }

  setContacts(isOn) {
    this.link_.tell('contacts', { wanted: isOn });
    part('legend').hidden = !isOn || !this.hasBudget_;
    if (!isOn) this.contacts_.show(null);
    this.stage_.change();
  }

  setReplaying(isOn) {
    this.bodies_.visible = !isOn;
    part('legend').hidden = isOn || !this.hasBudget_ || !this.showContacts_.isOn;
    this.contacts_.object.visible = !isOn;
    this.hand_.setCloud(isOn ? null : (this.cloud_ ?? null));
    this.link_.tell('run', { running: !isOn && !this.pause_.isOn });
    if (!isOn && this.pit_) this.stage_.showPit({ half: this.pit_ });
    this.showStatus();
  }

  /// Takes a frame of the engine; it is shown with the next picture.
  take(frame) {
    this.waiting_ = frame;
    this.recorder_.add(frame.step, frame.poses);
    for (const { stepMs, narrowPhaseMs, operations } of frame.samples) {
      this.timeChart_.add(narrowPhaseMs ?? stepMs, narrowPhaseMs === null ? null : stepMs);
      this.workChart_.add(operations);
    }
    this.samples_?.push(...frame.samples);
  }

  showFrame() {
    const frame = this.waiting_;
    if (!frame) return;
    this.waiting_ = null;
    const hasMoved = frame.poses.some((value, k) => value !== this.cloud_.poses[k]);
    if (hasMoved) this.cloud_.place(frame.poses);
    if (this.showContacts_.isOn) this.contacts_.show(frame.contacts, this.leafErrors_);
    if (hasMoved || frame.contacts) this.stage_.change();
    const last = frame.samples.at(-1);
    part('open-pairs').value = countText(last.unresolvedPairs ?? 0);
    Object.assign(this, { asleep_: frame.asleep, step_: frame.step, last_: last });
    this.link_.tell('shown');
  }

  showStatus() {
    if (this.replay_?.isOn) part('status').textContent = 'Replay';
    else if (this.engine_ && !this.isLoading_) {
      const chosen = this.hand_.chosen === null ? '' : `; body ${this.hand_.chosen + 1} ${this.hand_.holds ? 'held' : 'chosen'}`;
      part('status').textContent = `${this.engine_.name} ${this.engine_.version}: ${this.cloud_.count} bodies, ${this.asleep_} asleep${chosen}`;
    }
  }

  showNumbers() {
    const { last_: last } = this;
    if (!last) return;
    const told = last.narrowPhaseMs !== null;
    const most = (name) => millisecondsText(quantile(this.timeChart_.values(name), 0.99));
    part('time-now').value = millisecondsText(last.narrowPhaseMs ?? last.stepMs);
    part('work-now').value = last.operations === null ? '' : `${countText(last.operations)} operations`;
    const name = this.engine_?.name;
    part('time-facts').textContent = told
      ? `Filled: collision detection (narrow phase), 99\u00a0% below ${most('filled')}. Line: the whole step, 99\u00a0% below ${most('line')}.`
      : `${name} does not tell its collision detection apart. Filled: the whole step, 99\u00a0% below ${most('filled')}.`;
    this.showStatus();
  }

  /// One picture, as often as the browser wants one.
  draw(now) {
    if (this.lastDraw_ && !document.hidden && !this.drawings_) this.stage_.noteFrame(now - this.lastDraw_);
    this.lastDraw_ = now;
    if (this.replay_.isOn) this.replay_.show(now);
    else this.showFrame();
    if (this.hand_.update()) this.stage_.change();
    if (this.stage_.hasChanged && this.isDrawing) {
      const drawn = this.stage_.draw(this.drawings_ !== undefined);
      this.drawings_?.push(drawn);
    }
    this.intervals_?.push(now);
    if (!(now - this.lastTold_ < kTold)) {
      this.lastTold_ = now;
      this.showNumbers();
      this.timeChart_.draw();
      this.workChart_.draw();
    }
    requestAnimationFrame((then) => this.draw(then));
  }

  // For tests and measurements.

  state() {
    const { engine_: engine, step_: step, asleep_: asleep, last_: last } = this;
    const poses = this.cloud_?.poses;
    return { engine, step, asleep, last, bodies: this.cloud_?.count ?? 0, poses: poses && [...poses], contacts: this.contacts_.shown, quality: this.stage_.quality, held: this.hand_.holds ? this.hand_.chosen : null, chosen: this.hand_.chosen, isReplaying: this.replay_.isOn, replay: this.replay_.state() };
  }

  /// Collects what steps and pictures cost for some seconds. Each picture is waited for.
  async measure(seconds) {
    Object.assign(this, { samples_: [], drawings_: [], intervals_: [] });
    await new Promise((done) => setTimeout(done, 1000 * seconds));
    const { samples_: steps, drawings_: drawings, intervals_: at } = this;
    Object.assign(this, { samples_: undefined, drawings_: undefined, intervals_: undefined });
    return { steps, drawings, frames: at.slice(1).map((time, k) => time - at[k]) };
  }

  placeOf(body) {
    return this.stage_.onPage(this.cloud_.middleOf(body));
  }

  /// The body that is seen at a place of the page; null for none.
  bodyAt(x, y) {
    return this.cloud_.hit(this.stage_.rayThrough(x, y))?.body ?? null;
  }
}

async function start() {
  try {
    const page = new Page(await loadModels());
    window.cairnWeb = page;
    await page.drop();
    requestAnimationFrame((now) => page.draw(now));
  } catch (error) {
    refuse(error.message);
  }
}

start();

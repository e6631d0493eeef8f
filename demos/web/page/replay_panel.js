// SPDX-License-Identifier: GPL-3.0-or-later
//
// Controls of the replay: what is shown again, and when of it.
import { part, refuse } from './panel.js';
import { runOf, textOf } from './recording.js';
import { makeReplay } from './replay.js';
import { tracksOfGeoJson, tracksOfVtk } from './trajectories.js';

const kMaxBytes = 400e6;
const kRocks = 'models/rocks.vtk'; // there when the page was built with an example
const kPause = 1; // s at the end, before it begins again

/// Reads a run or trajectories, by what the text is.
export function readRun(text, models) {
  if (text.startsWith('# vtk')) return tracksOfVtk(text);
  if (/^\s*\{\s*"type"\s*:\s*"FeatureCollection"/.test(text)) return tracksOfGeoJson(text);
  return runOf(text, models);
}

export class ReplayPanel {
  /// `recorderOf` gives what is being recorded, `onChange` is told whether a replay is on.
  constructor(stage, { bodies: models, hasRocks }, recorderOf, onChange) {
    Object.assign(this, { stage_: stage, models_: models, recorderOf_: recorderOf, onChange_: onChange, replay_: null });
    part('replay-last').addEventListener('click', () => this.openLast());
    part('open').addEventListener('click', () => part('file').click());
    part('file').addEventListener('change', () => this.openFile());
    part('save').addEventListener('click', () => this.save());
    part('live').addEventListener('click', () => this.close());
    part('replay-rocks').addEventListener('click', () => this.openRocks());
    part('replay').addEventListener('input', () => this.seek(part('replay').value / part('replay').max));
    part('replay-rocks').hidden = !hasRocks;
  }

  get isOn() {
    return this.replay_ !== null;
  }

  openLast() {
    const run = this.recorderOf_()?.run();
    if (run?.frames.length > 1) this.open(run);
  }

  async openRocks() {
    await this.tryTo(async () => tracksOfVtk(await (await fetch(new URL(kRocks, document.baseURI))).text()));
  }

  async openFile() {
    const [file] = part('file').files;
    part('file').value = '';
    if (!file) return;
    await this.tryTo(async () => {
      if (file.size > kMaxBytes) throw new Error(`${file.name} is larger than 400 MB; merge fewer runs.`);
      return readRun(await file.text(), this.models_.map(({ name }) => name));
    });
  }

  async tryTo(read) {
    try {
      this.open(await read());
      refuse('');
    } catch (error) {
      refuse(error.message);
    }
  }

  open(run) {
    this.close();
    this.replay_ = makeReplay(this.stage_, run, this.models_);
    this.start_ = null;
    this.stage_.add(this.replay_.object);
    part('replay-about').textContent = this.replay_.about;
    this.showControls();
    this.onChange_(true);
    this.replay_.show(0);
  }

  close() {
    if (!this.replay_) return;
    this.stage_.remove(this.replay_.object);
    this.replay_.free();
    this.replay_ = null;
    this.showControls();
    this.onChange_(false);
  }

  showControls() {
    part('replay-section').hidden = part('live').hidden = !this.isOn;
    part('replay-time').value = '';
  }

  seek(share) {
    this.start_ = performance.now() - 1000 * share * this.replay_.duration;
  }

  /// Shows what belongs to a time of the page's clock, in milliseconds.
  show(now) {
    this.start_ ??= now;
    const { duration } = this.replay_;
    const time = ((now - this.start_) / 1000) % (duration + kPause);
    const shown = Math.min(Math.max(time, 0), duration);
    this.replay_.show(shown);
    this.stage_.change();
    part('replay').value = (part('replay').max * shown) / Math.max(duration, 1e-9);
    part('replay').style.setProperty('--share', shown / Math.max(duration, 1e-9));
    const text = `${shown.toFixed(1)} of ${duration.toFixed(1)} s`;
    part('replay-time').value = text;
    part('replay').setAttribute('aria-valuetext', text);
  }

  save() {
    const run = this.recorderOf_()?.run();
    if (!run?.frames.length) return;
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([textOf(run)], { type: 'application/json' }));
    link.download = 'cairn-run.json';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  state() {
    return this.replay_ ? { about: this.replay_.about, duration: this.replay_.duration, time: part('replay-time').value } : null;
  }
}

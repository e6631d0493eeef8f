// SPDX-License-Identifier: GPL-3.0-or-later
//
// What was seen, kept for a minute, as a file, and back.

import { kFarthest, kLongest } from './bounds.js';

const kMaxFrames = 3600; // a minute of them
const kMaxBodies = 5000;
const kFormat = 'cairn-run';
const kTimeStep = 1 / 60;
const kUnitWithin = 0.01; // of the length of a rotation's quaternion

export class Recorder {
  /// models: names of models; bodies: the index of each one's model.
  constructor(engine, models, bodies) {
    Object.assign(this, { engine, models, bodies });
    this.steps = [];
    this.frames = [];
  }

  add(step, poses) {
    this.steps.push(step);
    this.frames.push(poses);
    if (this.steps.length > kMaxFrames) {
      this.steps.shift();
      this.frames.shift();
    }
  }

  run() {
    const { engine, models, bodies, steps, frames } = this;
    return { kind: 'bodies', engine, models, bodies, times: steps.map((step) => (step - steps[0]) * kTimeStep), frames: [...frames] };
  }
}

function base64Of(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

const isUnit = (poses, at) => Math.abs(Math.hypot(...poses.subarray(at + 3, at + 7)) - 1) <= kUnitWithin;

/// Brings poses of bodies that fell or flew out of the world back to its edge, where they can be read again.
function bound(poses) {
  for (let at = 0; at < poses.length; at += 7) {
    for (let k = at; k < at + 3; ++k) poses[k] = Number.isNaN(poses[k]) ? kFarthest : Math.min(Math.max(poses[k], -kFarthest), kFarthest);
    if (!isUnit(poses, at)) poses.set([0, 0, 0, 1], at + 3);
  }
}

/// Throws for poses that cannot be shown.
function checkPoses(poses) {
  for (let at = 0; at < poses.length; at += 7) {
    const place = poses.subarray(at, at + 3);
    if (!poses.subarray(at, at + 7).every(Number.isFinite)) refuse('a pose is no number');
    if (place.some((c) => Math.abs(c) > kFarthest)) refuse('a body is farther than 1000 km away');
    if (!isUnit(poses, at)) refuse('a rotation is no unit quaternion');
  }
}

/// The text of a file of a run.
export function textOf({ engine, models, bodies, times, frames }) {
  const poses = new Float32Array(frames.length * 7 * bodies.length);
  frames.forEach((frame, index) => poses.set(frame, index * 7 * bodies.length));
  bound(poses);
  return JSON.stringify({ format: kFormat, version: 1, engine, models, bodies, times, poses: base64Of(new Uint8Array(poses.buffer)) });
}

const refuse = (what) => {
  throw new Error(`This file is no run of this page: ${what}. Save a run here, or open trajectories of rockfall merge.`);
};

function checkHeader({ format, version, engine, models, bodies, times, poses }, known) {
  if (format !== kFormat) refuse('it does not say so');
  if (version !== 1) refuse(`its version is ${version}, not 1`);
  if (typeof engine !== 'string' || typeof poses !== 'string') refuse('engine or poses are missing');
  for (const list of [models, bodies, times]) if (!Array.isArray(list) || list.length === 0) refuse('models, bodies or times are missing');
  if (models.length > known.length) refuse('it names more models than this page has');
  for (const name of models) if (!known.includes(name)) refuse(`the model ${String(name).slice(0, 40)} is not on this page`);
  if (bodies.length > kMaxBodies) refuse(`it has more than ${kMaxBodies} bodies`);
  for (const model of bodies) if (!Number.isInteger(model) || model < 0 || model >= models.length) refuse('a body has no model');
  times.forEach((time, k) => (Number.isFinite(time) && time >= 0 && (k === 0 || time > times[k - 1])) || refuse('its times do not rise'));
  if (times.at(-1) > kLongest) refuse('it is longer than a day');
}

/// Reads a run; `known` names the models of the page. Throws one sentence.
export function runOf(text, known) {
  let data;
  try {
    data = JSON.parse(text);
  } catch {
    refuse('it is not JSON');
  }
  if (typeof data !== 'object' || data === null) refuse('it does not say so');
  checkHeader(data, known);
  const { engine, models, bodies, times } = data;
  let bytes;
  try {
    bytes = Uint8Array.from(atob(data.poses), (c) => c.charCodeAt(0));
  } catch {
    refuse('its poses are not base64');
  }
  if (bytes.length !== times.length * bodies.length * 28) refuse('it is cut short');
  const poses = new Float32Array(bytes.buffer);
  checkPoses(poses);
  const frames = times.map((_, k) => poses.slice(k * 7 * bodies.length, (k + 1) * 7 * bodies.length));
  return { kind: 'bodies', engine: engine.slice(0, 80), models, bodies, times, frames };
}

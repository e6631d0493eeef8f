// SPDX-License-Identifier: GPL-3.0-or-later
//
// One engine and one world, away from the drawing. Messages in name what to `do`; messages out name what was done.
import { kLoaders } from './engine_loaders.js';
import { boxesOf } from './scene_plan.js';

const kTimeStep = 1 / 60;
const kGravity = [0, -9.81, 0];
const kMaxSamples = 600; // that wait for a page that shows nothing, as a hidden one; the charts have room for fewer
const kMaxBehind = 100; // ms; a world that falls behind further runs slower than time, as steps do not get longer

let engine = null;
let engineId = null;
let shapes = [];
let world = null;
let number = 0; // of the scene, as the page counts
let budget = {};
let isRunning = false;
let wantsContacts = true;
let steps = 0;
let due = 0;
let timer = null;
let samples = [];
let isFrameOwed = false; // the page has shown the last frame and can take another

function dropWorld() {
  world?.free();
  shapes.forEach((shape) => shape.free());
  world = null;
  shapes = [];
}

async function choose(id) {
  dropWorld();
  if (engineId === id) return;
  engine = await kLoaders[id]();
  engineId = id;
}

function fill({ models, bodies, pit, seed }) {
  shapes = models.map((model) => engine.prepare(model));
  world = engine.createWorld({ gravity: kGravity, timeStep: kTimeStep, seed });
  for (const { halfExtents, position } of boxesOf(pit)) world.addBox(halfExtents, position, [0, 0, 0, 1]);
  for (const { model, position, rotation } of bodies) world.addBody(shapes[model], { position, rotation });
  world.setBudget?.(budget);
  steps = 0;
  samples = [];
}

function takeStep() {
  world.step();
  ++steps;
  const { stepMs, narrowPhaseMs } = world.times();
  const { operations = null, unresolvedPairs = null, worstErrorFraction = null, pairs = null } = world.statistics?.() ?? {};
  samples.push({ step: steps, stepMs, narrowPhaseMs, operations, unresolvedPairs, worstErrorFraction, pairs });
  if (samples.length > kMaxSamples) samples.shift();
}

function sendFrame() {
  if (!isFrameOwed || samples.length === 0) return;
  isFrameOwed = false;
  const poses = world.transforms().slice();
  const contacts = (wantsContacts && world.contacts()?.slice()) || null;
  const message = { did: 'frame', number, step: steps, poses, contacts, samples, asleep: world.asleep() };
  samples = [];
  postMessage(message, contacts ? [poses.buffer, contacts.buffer] : [poses.buffer]);
}

function tick() {
  timer = null;
  if (!isRunning || !world) return;
  const now = performance.now();
  if (now - due > kMaxBehind) due = now;
  try {
    takeStep();
  } catch (error) {
    isRunning = false;
    postMessage({ did: 'fault', message: error.message });
    return;
  }
  sendFrame();
  due += 1000 * kTimeStep;
  timer = setTimeout(tick, Math.max(0, due - performance.now()));
}

function run(running) {
  isRunning = running;
  due = performance.now();
  if (isRunning && timer === null) timer = setTimeout(tick, 0);
}

const actions = {
  async scene({ id, scene, number: wanted }) {
    run(false);
    number = wanted;
    await choose(id);
    fill(scene);
    postMessage({ did: 'scene', number, engine: { name: engine.name, version: engine.version }, hasBudget: Boolean(world.setBudget) });
    isFrameOwed = true;
    run(scene.isRunning);
  },
  budget(message) {
    ({ budget } = message);
    world?.setBudget?.(budget);
  },
  contacts({ wanted }) {
    wantsContacts = wanted;
  },
  drag: ({ index, point, target }) => world?.drag(index, point, target),
  run: ({ running }) => run(running),
  step() {
    if (!world) return;
    takeStep();
    isFrameOwed = true;
    sendFrame();
  },
  shown() {
    isFrameOwed = true;
    if (!isRunning && world) sendFrame();
  },
};

let turn = Promise.resolve(); // one message after the other, as loading takes time
onmessage = ({ data }) => {
  turn = turn.then(() => actions[data.do](data)).catch((error) => postMessage({ did: 'fault', message: error.message }));
};

// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of one contestant, in a process of its own: node run.mjs CONFIG.json. Prints what it measured as JSON.
import { readFileSync } from 'node:fs';
import { kContestants } from './contestants.mjs';
import { makePatience } from './measured.mjs';
import { countLost, halfWidthOf, kScenes, pitBoxes, randomOf } from './scenes.mjs';

const kGravity = [0, -9.81, 0];
const kTimeStep = 1 / 60;
const kWarmUp = { bodies: 15, steps: 150 }; // so that compiling and first allocations are nobody's step

const config = JSON.parse(readFileSync(process.argv[2]));
const contestant = kContestants[config.contestant];
const scene = kScenes[config.scene];

function modelOf({ mesh, tree, hulls }) {
  const { name, vertices, indices } = JSON.parse(readFileSync(mesh));
  const parts = JSON.parse(readFileSync(hulls))[contestant.hulls ?? 16];
  return {
    name,
    vertices: Float32Array.from(vertices),
    indices: Uint32Array.from(indices),
    tree: new Uint8Array(readFileSync(tree)),
    hulls: parts.map((part) => Float32Array.from(part)),
    mass: 1,
  };
}

function worldOf(engine, shape, bodies, seed) {
  const world = engine.createWorld({ gravity: kGravity, timeStep: kTimeStep, seed });
  if (contestant.budget) world.setBudget(contestant.budget);
  for (const { halfExtents, position, rotation } of pitBoxes(halfWidthOf(bodies))) world.addBox(halfExtents, position, rotation);
  for (const pose of scene.start(bodies, randomOf(seed))) world.addBody(shape, pose);
  return world;
}

const cpuMs = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};

/// Steps a world. Where its steps are longer than can be waited for, it is `stopped` and told at which step.
function measure(world, { steps, frames, longest = Infinity }) {
  const measured = { cpuMs: [], wallMs: [], narrowPhaseMs: [], missedMs: [], frames: [] };
  const isPatient = makePatience(longest);
  for (let step = 1; step <= steps; ++step) {
    const before = cpuMs();
    world.step();
    measured.cpuMs.push(cpuMs() - before);
    if (!isPatient(measured.cpuMs.at(-1))) return { stopped: step };
    const { stepMs, narrowPhaseMs } = world.times();
    measured.wallMs.push(stepMs);
    if (narrowPhaseMs !== null) measured.narrowPhaseMs.push(narrowPhaseMs);
    if (contestant.budget?.microseconds) measured.missedMs.push(world.statistics().missedByMicroseconds / 1000);
    if (frames.includes(step)) measured.frames.push({ step, poses: [...world.transforms()] });
  }
  return measured;
}

function told(world, measured) {
  if (measured.stopped) return { stopped: measured.stopped, over: config.longest };
  const last = measured.frames.at(-1).poses;
  const counts = { asleep: world.asleep(), lost: countLost(last, halfWidthOf(config.bodies)), apart: scene.apart ? scene.apart(last) : null };
  return { ...counts, hash: world.stateHash?.() ?? null, ...measured };
}

const engine = await (await import(`../engines/${contestant.engine}.mjs`)).load({ shape: contestant.shape, simd: contestant.simd });
const shape = engine.prepare(modelOf(config.model));
const first = worldOf(engine, shape, kWarmUp.bodies, 1000);
measure(first, { steps: kWarmUp.steps, frames: [] });
first.free();

const world = worldOf(engine, shape, config.bodies, config.seed);
const { name, version } = engine;
process.stdout.write(JSON.stringify({ engine: name, version, ...told(world, measure(world, config)) }));

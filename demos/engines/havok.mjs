// SPDX-License-Identifier: GPL-3.0-or-later
//
// Havok, as Babylon.js packages it: moving triangle meshes, or the parts of hulls.mjs in a container.
import { chosenShape, Drags, dragImpulse, hullsOf, kFriction } from './common.mjs';
import { massProperties } from './mass.mjs';
import { add, rotate } from './vectors.mjs';

const kShapes = ['mesh', 'hulls'];
const kVersion = '1.3.14'; // the module does not tell it; package.json pins it
const kStill = [[0, 0, 0], [0, 0, 0, 1], [1, 1, 1]];

/// Where WebAssembly lies is found by the bundler in a browser. Node has to read it.
async function start() {
  const { default: create } = await import('@babylonjs/havok');
  if (typeof process === 'undefined' || !process.versions?.node) return create();
  const files = 'node:fs/promises'; // a variable, so that no bundler looks for it
  const { readFile } = await import(/* @vite-ignore */ files);
  const file = import.meta.resolve('@babylonjs/havok/lib/esm/HavokPhysics.wasm');
  return create({ wasmBinary: await readFile(new URL(file)) });
}

/// The value of a call, which gives a result code first.
function value(havok, what, answer) {
  const [code, made] = Array.isArray(answer) ? answer : [answer];
  if (code !== havok.Result.RESULT_OK) throw new Error(`Havok: ${what} was refused (code ${code.value ?? code}).`);
  return made;
}

/// Runs `use` with copies of arrays in the module's memory.
function inMemory(havok, arrays, use) {
  const places = arrays.map((array) => havok._malloc(array.byteLength));
  arrays.forEach((array, index) => havok.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), places[index]));
  try {
    return use(...places);
  } finally {
    places.forEach((place) => havok._free(place));
  }
}

function hullOf(havok, hull) {
  return inMemory(havok, [hull], (points) => value(havok, 'a hull', havok.HP_Shape_CreateConvexHull(points, hull.length / 3)));
}

function meshOf(havok, { vertices, indices }) {
  return inMemory(havok, [vertices, indices], (points, triangles) =>
    value(havok, 'a mesh', havok.HP_Shape_CreateMesh(points, vertices.length / 3, triangles, indices.length / 3)),
  );
}

function setMaterial(havok, shape) {
  const { MINIMUM, GEOMETRIC_MEAN } = havok.MaterialCombine;
  value(havok, 'a material', havok.HP_Shape_SetMaterial(shape, [kFriction, kFriction, 0, GEOMETRIC_MEAN, MINIMUM]));
}

/// The body's shape and all that were made for it. A container has no material of its own.
function shapesOf(havok, kind, model) {
  const solids = kind === 'mesh' ? [meshOf(havok, model)] : hullsOf('Havok', model).map((hull) => hullOf(havok, hull));
  for (const solid of solids) setMaterial(havok, solid);
  if (kind === 'mesh') return { shape: solids[0], all: solids };
  const shape = value(havok, 'a container', havok.HP_Shape_CreateContainer());
  for (const solid of solids) value(havok, 'a part', havok.HP_Shape_AddChild(shape, solid, kStill));
  return { shape, all: [shape, ...solids] };
}

class HavokWorld {
  drags = new Drags();
  bodies = [];
  boxes = [];
  poses = new Float32Array(0);
  stepMs = 0;

  constructor(havok, { gravity, timeStep }) {
    this.havok = havok;
    this.timeStep = timeStep;
    this.world = value(havok, 'a world', havok.HP_World_Create());
    havok.HP_World_SetGravity(this.world, [...gravity]);
    havok.HP_World_SetIdealStepTime(this.world, timeStep);
  }

  create(shape, motion, position, rotation) {
    const { havok } = this;
    const body = value(havok, 'a body', havok.HP_Body_Create());
    value(havok, 'a shape', havok.HP_Body_SetShape(body, shape));
    havok.HP_Body_SetMotionType(body, motion);
    havok.HP_Body_SetQTransform(body, [[...position], [...rotation]]);
    return body;
  }

  addBody({ shape, properties }, { position, rotation, linearVelocity = [0, 0, 0] }) {
    const { havok } = this;
    const { center, mass, moments, axes } = properties;
    const body = this.create(shape, havok.MotionType.DYNAMIC, position, rotation);
    value(havok, 'a mass', havok.HP_Body_SetMassProperties(body, [center, mass, moments.map((part) => part / mass), axes]));
    havok.HP_Body_SetLinearVelocity(body, [...linearVelocity]);
    value(havok, 'a body', havok.HP_World_AddBody(this.world, body, false));
    this.poses = new Float32Array(7 * (this.bodies.length + 1));
    return this.bodies.push({ body, properties }) - 1;
  }

  addBox(halfExtents, position, rotation) {
    const { havok } = this;
    const extents = [...halfExtents].map((part) => 2 * part);
    const shape = value(havok, 'a box', havok.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], extents));
    setMaterial(havok, shape);
    const body = this.create(shape, havok.MotionType.STATIC, position, rotation);
    value(havok, 'a box', havok.HP_World_AddBody(this.world, body, false));
    this.boxes.push({ body, shape });
  }

  step() {
    for (const [index, grip] of this.drags) this.pull(this.bodies[index], grip);
    const start = performance.now();
    this.havok.HP_World_Step(this.world, this.timeStep);
    this.stepMs = performance.now() - start;
  }

  pull({ body, properties }, grip) {
    const { havok } = this;
    const [, [position, rotation]] = havok.HP_Body_GetQTransform(body);
    const state = {
      center: add(position, rotate(rotation, properties.center)),
      rotation,
      velocity: havok.HP_Body_GetLinearVelocity(body)[1],
      angularVelocity: havok.HP_Body_GetAngularVelocity(body)[1],
    };
    const { at, impulse } = dragImpulse(state, grip, properties, this.timeStep);
    havok.HP_Body_SetActivationState(body, havok.ActivationState.ACTIVE);
    havok.HP_Body_ApplyImpulse(body, at, impulse);
  }

  transforms() {
    this.bodies.forEach(({ body }, index) => {
      const [, [position, rotation]] = this.havok.HP_Body_GetQTransform(body);
      this.poses.set(position, 7 * index);
      this.poses.set(rotation, 7 * index + 3);
    });
    return this.poses;
  }

  times() {
    return { narrowPhaseMs: null, stepMs: this.stepMs };
  }

  contacts() {
    return null;
  }

  asleep() {
    const { havok } = this;
    return this.bodies.filter(({ body }) => havok.HP_Body_GetActivationState(body)[1] === havok.ActivationState.INACTIVE).length;
  }

  drag(index, point, target) {
    this.drags.set(index, point, target);
  }

  free() {
    const { havok } = this;
    for (const { body } of [...this.bodies, ...this.boxes]) {
      havok.HP_World_RemoveBody(this.world, body);
      havok.HP_Body_Release(body);
    }
    for (const { shape } of this.boxes) havok.HP_Shape_Release(shape);
    havok.HP_World_Release(this.world);
  }
}

export async function load({ shape } = {}) {
  const kind = chosenShape('Havok', kShapes, shape);
  const havok = await start();
  return {
    name: 'Havok',
    version: kVersion,
    shape: kind,
    shapes: kShapes,
    prepare(model) {
      const { shape, all } = shapesOf(havok, kind, model);
      return { shape, properties: massProperties(model), free: () => all.forEach((made) => havok.HP_Shape_Release(made)) };
    },
    createWorld: (options) => new HavokWorld(havok, options),
  };
}

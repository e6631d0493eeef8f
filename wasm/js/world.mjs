// SPDX-License-Identifier: Zlib
import { kRanges, numberIn, numbersIn, objectIn, optionsOf, placeIn, vectorIn, whole, wholeIn } from './ranges.mjs';
import { Shape } from './tree.mjs';

const policies = ['guard', 'repel', 'ignore', 'compensate'];
const ends = ['leaves', 'triangles'];
const limitNames = ['operations', 'microseconds'];
const statisticNames = [
  'operations', 'microseconds', 'elapsedMicroseconds', 'deadlineMicroseconds', 'missedByMicroseconds', 'pairs',
  'nonFinitePairs', 'unresolvedPairs', 'contacts', 'exactContacts', 'manifolds', 'worstErrorFraction',
  'meanErrorFraction', 'worstSeenError', 'meanSeenError',
];
const upright = [0, 0, 0, 1];

const placed = (position, rotation, where) => [
  ...vectorIn(kRanges.place, position, `${where}: the position`),
  ...numbersIn(kRanges.rotation, rotation, 4, `${where}: the rotation`),
];
const surface = ({ friction = 0.5, restitution = 0 }, where) => [
  numberIn(kRanges.friction, friction, `${where}: the friction`),
  numberIn(kRanges.restitution, restitution, `${where}: the restitution`),
];

// Infinite is no limit.
function limitsOf(budget, where) {
  if (budget === null) return [Infinity, Infinity];
  const given = objectIn(budget, `${where}: the budget`, 'microseconds: 2000');
  for (const name of Object.keys(given)) placeIn(limitNames, name, 'limit');
  return limitNames.map((name) => ((given[name] ?? Infinity) === Infinity ? Infinity : numberIn(kRanges[name], given[name], `${where}: the number of ${name}`)));
}

/** Bodies of trees between planes and boxes; index.d.ts says what the members mean. */
export class World {
  #memory;
  #exports;
  #handle;

  constructor(memory, options) {
    const where = 'makeWorld';
    const { gravity = [0, -9.81, 0], timeStep = 1 / 60, iterations, budget, unresolved, finest } = optionsOf(options, where, 'timeStep: 1 / 60');
    this.#memory = memory;
    this.#exports = memory.exports;
    const down = vectorIn(kRanges.gravity, gravity, `${where}: gravity`);
    memory.pass(...down, numberIn(kRanges.timeStep, timeStep, `${where}: the time step`));
    this.#handle = memory.check(this.#exports.cairn_world_make());
    this.timeStep = timeStep;
    this.#orUndo(() => this.#set({ iterations, budget, unresolved, finest }), () => this.free());
  }

  #set({ iterations, budget, unresolved, finest }) {
    if (iterations !== undefined) this.setIterations(iterations);
    if (budget !== undefined) this.setBudget(budget);
    if (unresolved !== undefined) this.setUnresolved(unresolved);
    if (finest !== undefined) this.setFinest(finest);
  }

  // What is refused half-way leaves nothing.
  #orUndo(call, undo) {
    try {
      call();
    } catch (error) {
      undo();
      throw error;
    }
  }

  get #world() {
    if (!this.#handle) throw new TypeError('this world was freed');
    return this.#handle;
  }

  // Calls a function of the world, which takes numbers from the place for arguments and returns 0 for a refusal.
  #call(name, numbers, ...more) {
    const world = this.#world;
    this.#memory.pass(...numbers);
    this.#memory.check(this.#exports[name](world, ...more));
  }
  #callOf(body, where, name, numbers) {
    this.#call(name, numbers, whole(body, `${where}: the body's number`));
  }
  #list(Kind, name) {
    return this.#memory.list(Kind, this.#exports[name](this.#world));
  }

  setGravity(gravity) {
    this.#call('cairn_world_gravity', vectorIn(kRanges.gravity, gravity, 'setGravity: gravity'));
  }
  setIterations(iterations) {
    this.#call('cairn_world_iterations', [], wholeIn(kRanges.iterations, iterations, 'setIterations: the number of iterations'));
  }
  setBudget(budget) {
    this.#call('cairn_world_budget', limitsOf(budget, 'setBudget'));
  }
  setUnresolved(policy) {
    this.#call('cairn_world_unresolved', [], placeIn(policies, policy, 'policy'));
  }
  setFinest(finest) {
    this.#call('cairn_world_finest', [], placeIn(ends, finest, 'end of refinement'));
  }

  addPlane(normal, offset, material) {
    const where = 'addPlane';
    const upward = vectorIn(kRanges.normal, normal, `${where}: the normal`);
    const length = numberIn(kRanges.normalLength, Math.hypot(...upward), `${where}: the normal's length`);
    numberIn(kRanges.place, offset, `${where}: the offset`);
    numberIn(kRanges.place, offset / length, `${where}: the offset over the normal's length`);
    this.#call('cairn_world_plane', [...upward, offset, ...surface(optionsOf(material, where, 'friction: 0.5'), where)]);
  }
  addBox(halfExtents, options) {
    const where = 'addBox';
    const given = optionsOf(options, where, 'position: [0, 1, 0]');
    const { position = [0, 0, 0], rotation = upright } = given;
    const size = vectorIn(kRanges.halfExtent, halfExtents, `${where}: a half extent`);
    this.#call('cairn_world_box', [...size, ...placed(position, rotation, where), ...surface(given, where)]);
  }
  addBody(shape, options) {
    const where = 'addBody';
    const given = optionsOf(options, where, 'position: [0, 1, 0]');
    const { position = [0, 0, 0], rotation = upright, mass = 1 } = given;
    const world = this.#world;
    const handle = Shape.handleIn(this.#memory, shape);
    const kilograms = mass === 0 ? 0 : numberIn(kRanges.mass, mass, `${where}: the mass`);
    this.#memory.pass(...placed(position, rotation, where), ...surface(given, where), kilograms);
    const body = this.#exports.cairn_world_body(world, handle);
    this.#memory.check(body >= 0);
    const { linearVelocity, angularVelocity } = given;
    if (linearVelocity || angularVelocity)
      this.#orUndo(() => this.setVelocity(body, linearVelocity, angularVelocity), () => this.removeBody(body));
    return body;
  }
  removeBody(body) {
    this.#callOf(body, 'removeBody', 'cairn_world_remove', []);
  }
  setPose(body, position, rotation = upright) {
    this.#callOf(body, 'setPose', 'cairn_world_pose', placed(position, rotation, 'setPose'));
  }
  setVelocity(body, linear = [0, 0, 0], angular = [0, 0, 0]) {
    const along = vectorIn(kRanges.velocity, linear, 'setVelocity: the linear velocity');
    this.#callOf(body, 'setVelocity', 'cairn_world_velocity', [...along, ...vectorIn(kRanges.turning, angular, 'setVelocity: the angular velocity')]);
  }
  drag(body, point, target) {
    if (point === null) return this.release(body);
    const held = vectorIn(kRanges.place, point, 'drag: the point');
    return this.#callOf(body, 'drag', 'cairn_world_drag', [...held, ...vectorIn(kRanges.place, target, 'drag: the target')]);
  }
  release(body) {
    this.#callOf(body, 'release', 'cairn_world_release', []);
  }

  step() {
    this.#call('cairn_world_step', []);
  }

  statistics() {
    const numbers = this.#list(Float64Array, 'cairn_world_statistics');
    const named = Object.fromEntries(statisticNames.map((name, i) => [name, numbers[i]]));
    if (named.deadlineMicroseconds === Infinity) named.deadlineMicroseconds = null;
    return named;
  }
  contacts() {
    return this.#list(Float32Array, 'cairn_world_contacts');
  }
  transforms() {
    return this.#list(Float32Array, 'cairn_world_transforms');
  }
  velocities() {
    return this.#list(Float32Array, 'cairn_world_velocities');
  }
  asleep() {
    return this.#list(Uint8Array, 'cairn_world_asleep');
  }
  stateHash() {
    return String.fromCharCode(...this.#list(Uint8Array, 'cairn_world_hash'));
  }

  free() {
    this.#exports.cairn_world_free(this.#handle);
    this.#handle = 0;
  }
}

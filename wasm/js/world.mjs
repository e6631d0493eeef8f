// SPDX-License-Identifier: Zlib
import { Shape } from './tree.mjs';

const policies = ['guard', 'repel', 'ignore', 'compensate'];
const ends = ['leaves', 'triangles'];
const statisticNames = [
  'operations', 'microseconds', 'elapsedMicroseconds', 'deadlineMicroseconds', 'missedByMicroseconds', 'pairs',
  'nonFinitePairs', 'unresolvedPairs', 'contacts', 'exactContacts', 'manifolds', 'worstErrorFraction',
  'meanErrorFraction', 'worstSeenError', 'meanSeenError',
];
const upright = [0, 0, 0, 1];

function placeIn(names, name, what) {
  const place = names.indexOf(name);
  if (place < 0) throw new TypeError(`there is no ${what} '${name}'; give one of ${names.join(', ')}`);
  return place;
}

// So many numbers: more would be written beyond the place for arguments, fewer would leave an older call's.
function numbersOf(list, count, what) {
  const numbers = [...list];
  if (numbers.length !== count) throw new TypeError(`${what} has ${numbers.length} numbers; give ${count}`);
  return numbers;
}
const vector = (list, what) => numbersOf(list, 3, what);
const poseOf = (position, rotation) => [...vector(position, 'the position'), ...numbersOf(rotation, 4, 'the rotation')];

// WebAssembly would make whole numbers of everything: 0 of NaN and of a name.
function whole(number, what) {
  if (number !== (number | 0)) throw new TypeError(`${what} is ${String(number)}; give a whole number`);
  return number;
}

// Infinite is no limit, and every negative amount is refused.
const limit = (amount = Infinity) => (amount < 0 ? -1 : (amount ?? Infinity));

/** Bodies of trees between planes and boxes; index.d.ts says what the members mean. */
export class World {
  #memory;
  #exports;
  #handle;

  constructor(memory, { gravity = [0, -9.81, 0], timeStep = 1 / 60, iterations, budget, unresolved, finest } = {}) {
    this.#memory = memory;
    this.#exports = memory.exports;
    memory.pass(...vector(gravity, 'gravity'), timeStep);
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
  #callOf(body, name, numbers) {
    this.#call(name, numbers, whole(body, "the body's number"));
  }
  #list(Kind, name) {
    return this.#memory.list(Kind, this.#exports[name](this.#world));
  }

  setGravity(gravity) {
    this.#call('cairn_world_gravity', vector(gravity, 'gravity'));
  }
  setIterations(iterations) {
    this.#call('cairn_world_iterations', [], whole(iterations, 'the number of iterations'));
  }
  setBudget(budget) {
    this.#call('cairn_world_budget', [limit(budget?.operations), limit(budget?.microseconds)]);
  }
  setUnresolved(policy) {
    this.#exports.cairn_world_unresolved(this.#world, placeIn(policies, policy, 'policy'));
  }
  setFinest(finest) {
    this.#exports.cairn_world_finest(this.#world, placeIn(ends, finest, 'end of refinement'));
  }

  addPlane(normal, offset, { friction = 0.5, restitution = 0 } = {}) {
    this.#call('cairn_world_plane', [...vector(normal, 'the normal'), offset, friction, restitution]);
  }
  addBox(halfExtents, { position = [0, 0, 0], rotation = upright, friction = 0.5, restitution = 0 } = {}) {
    this.#call('cairn_world_box', [...vector(halfExtents, 'the list of half extents'), ...poseOf(position, rotation), friction, restitution]);
  }
  addBody(shape, options = {}) {
    const { position = [0, 0, 0], rotation = upright, mass = 1, friction = 0.5, restitution = 0 } = options;
    const world = this.#world;
    const handle = Shape.handleIn(this.#memory, shape);
    this.#memory.pass(...poseOf(position, rotation), friction, restitution, mass);
    const body = this.#exports.cairn_world_body(world, handle);
    this.#memory.check(body >= 0);
    const { linearVelocity, angularVelocity } = options;
    if (linearVelocity || angularVelocity)
      this.#orUndo(() => this.setVelocity(body, linearVelocity, angularVelocity), () => this.removeBody(body));
    return body;
  }
  removeBody(body) {
    this.#callOf(body, 'cairn_world_remove', []);
  }
  setPose(body, position, rotation = upright) {
    this.#callOf(body, 'cairn_world_pose', poseOf(position, rotation));
  }
  setVelocity(body, linear = [0, 0, 0], angular = [0, 0, 0]) {
    this.#callOf(body, 'cairn_world_velocity', [...vector(linear, 'the linear velocity'), ...vector(angular, 'the angular velocity')]);
  }
  drag(body, point, target) {
    if (point === null) this.release(body);
    else this.#callOf(body, 'cairn_world_drag', [...vector(point, 'the point'), ...vector(target, 'the target')]);
  }
  release(body) {
    this.#callOf(body, 'cairn_world_release', []);
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
    return this.#memory.text(this.#exports.cairn_world_hash(this.#world));
  }

  free() {
    this.#exports.cairn_world_free(this.#handle);
    this.#handle = 0;
  }
}

// SPDX-License-Identifier: Zlib

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

/** Bodies of trees between planes and boxes; index.d.ts says what the members mean. */
export class World {
  #memory;
  #exports;
  #handle;

  constructor(memory, { gravity = [0, -9.81, 0], timeStep = 1 / 60, iterations, budget, unresolved, finest } = {}) {
    this.#memory = memory;
    this.#exports = memory.exports;
    memory.pass(...gravity, timeStep);
    this.#handle = memory.check(this.#exports.cairn_world_make());
    this.timeStep = timeStep;
    if (iterations !== undefined) this.setIterations(iterations);
    if (budget !== undefined) this.setBudget(budget);
    if (unresolved !== undefined) this.setUnresolved(unresolved);
    if (finest !== undefined) this.setFinest(finest);
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
  #list(Kind, name) {
    return this.#memory.list(Kind, this.#exports[name](this.#world));
  }

  setGravity(gravity) {
    this.#call('cairn_world_gravity', gravity);
  }
  setIterations(iterations) {
    this.#call('cairn_world_iterations', [], iterations);
  }
  setBudget(budget) {
    this.#call('cairn_world_budget', [budget?.operations ?? Infinity, budget?.microseconds ?? Infinity]);
  }
  setUnresolved(policy) {
    this.#exports.cairn_world_unresolved(this.#world, placeIn(policies, policy, 'policy'));
  }
  setFinest(finest) {
    this.#exports.cairn_world_finest(this.#world, placeIn(ends, finest, 'end of refinement'));
  }

  addPlane(normal, offset, { friction = 0.5, restitution = 0 } = {}) {
    this.#call('cairn_world_plane', [...normal, offset, friction, restitution]);
  }
  addBox(halfExtents, { position = [0, 0, 0], rotation = upright, friction = 0.5, restitution = 0 } = {}) {
    this.#call('cairn_world_box', [...halfExtents, ...position, ...rotation, friction, restitution]);
  }
  addBody(shape, options = {}) {
    const { position = [0, 0, 0], rotation = upright, mass = 1, friction = 0.5, restitution = 0 } = options;
    const world = this.#world;
    this.#memory.pass(...position, ...rotation, friction, restitution, mass);
    const body = this.#exports.cairn_world_body(world, shape.handle);
    this.#memory.check(body >= 0);
    const { linearVelocity, angularVelocity } = options;
    if (linearVelocity || angularVelocity) this.setVelocity(body, linearVelocity, angularVelocity);
    return body;
  }
  removeBody(body) {
    this.#call('cairn_world_remove', [], body);
  }
  setPose(body, position, rotation = upright) {
    this.#call('cairn_world_pose', [...position, ...rotation], body);
  }
  setVelocity(body, linear = [0, 0, 0], angular = [0, 0, 0]) {
    this.#call('cairn_world_velocity', [...linear, ...angular], body);
  }
  drag(body, point, target) {
    if (point === null) this.release(body);
    else this.#call('cairn_world_drag', [...point, ...target], body);
  }
  release(body) {
    this.#call('cairn_world_release', [], body);
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

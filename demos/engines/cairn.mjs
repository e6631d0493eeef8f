// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cairn in Bullet, as its npm package has it. Bodies are sphere-trees with contacts between the meshes ('tree') or between the
// tree's leaves ('leaves').
import { load as loadCairn } from 'cairn-collision';

import { chosenShape } from './common.mjs';

const kFriction = 0.5;  // Bullet multiplies: 0.25 for a pair

export async function load(options = {}) {
  const cairn = await loadCairn(options.cairn);
  const shapes = ['tree', 'leaves'];
  const shape = chosenShape('cairn', shapes, options.shape);
  return {
    name: 'Cairn',
    version: cairn.version,
    shape,
    shapes,
    prepare(model) {
      if (!model.tree) throw new Error(`cairn: ${model.name} has no tree; make one with: cairn build MESH -o TREE.cairn`);
      const tree = cairn.readTree(model.tree, model.name);
      const made = cairn.makeShape(tree);
      tree.free();
      return { made, mass: model.mass, free: () => made.free() };
    },
    createWorld: (world) => new CairnWorld(cairn, { finest: shape === 'tree' ? 'triangles' : 'leaves', ...world }),
  };
}

// No limit is 0 or nothing.
const limits = ({ operations, microseconds } = {}) => ({
  operations: operations || undefined,
  microseconds: microseconds || undefined,
});

class CairnWorld {
  #world;
  #stepMs = 0;

  constructor(cairn, { gravity, timeStep, budget, unresolved, finest, iterations }) {
    this.#world = cairn.makeWorld({ gravity, timeStep, budget: limits(budget), unresolved, finest, iterations });
  }

  addBody({ made, mass }, { position, rotation, linearVelocity }) {
    return this.#world.addBody(made, { position, rotation, linearVelocity, mass, friction: kFriction });
  }
  addBox(halfExtents, position, rotation) {
    this.#world.addBox(halfExtents, { position, rotation, friction: kFriction });
  }
  /** Solid is where the product of a point with `normal` is below `offset`. */
  addPlane(normal, offset) {
    this.#world.addPlane(normal, offset, { friction: kFriction });
  }
  removeBody(body) {
    this.#world.removeBody(body);
  }
  step() {
    const began = performance.now();
    this.#world.step();
    this.#stepMs = performance.now() - began;
  }
  transforms() {
    return this.#world.transforms();
  }
  times() {
    return { narrowPhaseMs: this.#world.statistics().elapsedMicroseconds / 1000, stepMs: this.#stepMs };
  }
  /** Twelve numbers a contact, as `World.contacts` of cairn-collision has them. */
  contacts() {
    return this.#world.contacts();
  }
  statistics() {
    return this.#world.statistics();
  }
  asleep() {
    return this.#world.asleep().reduce((count, state) => count + (state === 1 ? 1 : 0), 0);
  }
  setBudget(budget) {
    this.#world.setBudget(limits(budget));
  }
  setUnresolved(policy) {
    this.#world.setUnresolved(policy);
  }
  setFinest(finest) {
    this.#world.setFinest(finest);
  }
  drag(body, point, target) {
    this.#world.drag(body, point, target);
  }
  stateHash() {
    return this.#world.stateHash();
  }
  free() {
    this.#world.free();
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all engines are told alike.
import { add, cross, length, rotate, scale, subtract } from './vectors.mjs';

/// Friction of each body. Rapier averages, Jolt and Havok take the geometric mean: 0.25 for a pair. Bullet multiplies 0.5 and 0.5.
export const kFriction = 0.25;

// A function that uses one instruction of 128 bits.
const kUsesVectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);

/// Whether this host has WebAssembly's vectors.
export const hasVectors = () => WebAssembly.validate(kUsesVectors);

/// The shape that was asked for, or the engine's first.
export function chosenShape(engine, shapes, wanted) {
  const shape = wanted ?? shapes[0];
  if (!shapes.includes(shape)) throw new Error(`${engine}: no shape is named ${shape}; choose one of ${shapes.join(', ')}.`);
  return shape;
}

export function hullsOf(engine, { name, hulls }) {
  if (!hulls?.length) throw new Error(`${engine}: ${name} has no convex parts; make them with decompose() of hulls.mjs.`);
  return hulls;
}

const kStiffness = 90; // 1/s^2, of a spring for each kilogram: a body follows the hand within a tenth of a second
const kDamping = 14; // 1/s; the spring is damped a little below critical
const kMaxChange = 1.5; // m/s that one step may add at most, so that a far target does not shoot the body

/// The impulse of one step that pulls a point of a body to a target. `state` has position and velocity of the centre of mass,
/// rotation and angular velocity.
export function dragImpulse(state, { point, target }, { center, mass }, timeStep) {
  const arm = rotate(state.rotation, subtract(point, center));
  const at = add(state.center, arm);
  const velocity = add(state.velocity, cross(state.angularVelocity, arm));
  const change = add(scale(subtract(target, at), kStiffness * timeStep), scale(velocity, -kDamping * timeStep));
  const speed = Math.hypot(...change);
  return { at, impulse: scale(change, mass * Math.min(1, kMaxChange / Math.max(length(change), 1e-9))) };
}

/// Drags of a world: what `World.drag` of every engine does.
export class Drags {
  grips = new Map();

  set(index, point, target) {
    if (point === null) this.grips.delete(index);
    else this.grips.set(index, { point: [...point], target: [...target] });
  }

  [Symbol.iterator]() {
    return this.grips.entries();
  }
}

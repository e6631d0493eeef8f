// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every engine of this folder offers, so that one scene runs in each of them.
// Lengths are metres, masses kilograms, times seconds unless a name ends in Ms (milliseconds).

export type Vec3 = ArrayLike<number>; // x y z
export type Quat = ArrayLike<number>; // x y z w

export interface Model {
  name: string;
  vertices: Float32Array; // x y z; the body's own frame
  indices: Uint32Array; // three a triangle, outward by the right hand; the surface is closed
  tree?: Uint8Array; // bytes of a .cairn of this mesh in this frame; only Cairn reads it
  hulls?: Float32Array[]; // points of convex parts, of hulls.mjs; engines of convex shapes need them
  mass: number;
}

export interface LoadOptions {
  shape?: string; // one of the engine's shapes; the first when left out
  simd?: boolean; // Rapier only: the build with vectors, which is taken where the host has them, or the one without
}

export interface Engine {
  name: string;
  version: string;
  shape: string; // what a body is made of
  shapes: string[]; // what it can be made of, best first
  prepare(model: Model): Shape; // may be shared by any number of worlds and bodies
  createWorld(options: { gravity: Vec3; timeStep: number; seed?: number }): World;
}

export interface Shape {
  free(): void; // after all worlds that use it
}

export interface Budget {
  operations?: number; // 0 or left out: no limit
  microseconds?: number;
}

export interface World {
  /// `position` and `rotation` place the model's frame. Bodies count from 0; boxes are not counted.
  addBody(shape: Shape, pose: { position: Vec3; rotation: Quat; linearVelocity?: Vec3 }): number;
  addBox(halfExtents: Vec3, position: Vec3, rotation: Quat): void; // does not move
  step(): void;
  transforms(): Float32Array; // x y z qx qy qz qw a body; valid until the next call
  times(): { narrowPhaseMs: number | null; stepMs: number }; // of the last step
  contacts(): Float32Array | null; // twelve numbers each, as cairn-collision has them; null where the engine does not tell them
  statistics?(): { operations: number; unresolvedPairs: number; worstErrorFraction: number; pairs: number }; // of the last step
  asleep(): number;
  setBudget?(budget: Budget): void;
  /// Pulls the point of the body (in its frame) to `target` (in the world) in each step until `point` is null.
  drag(index: number, point: Vec3 | null, target?: Vec3): void;
  free(): void;
}

export function load(options?: LoadOptions): Promise<Engine>;

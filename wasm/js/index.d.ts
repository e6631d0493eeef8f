// SPDX-License-Identifier: Zlib
//
// Lengths are metres, masses kilograms, times seconds unless a name says otherwise. What is refused throws a CairnError, whose
// message is one sentence. A wrong name, a thing of another kind or a freed object throws a TypeError.
//
// Ranges. Each number is taken from a range, which its comment states. Beyond it floats lose what a step needs, so it is refused.
// Places are -1e6 to 1e6 m in each coordinate.
//
// Memory. A call for which there is not enough memory throws a CairnError and changes nothing. Where a step was broken off all
// the same, every later call of that world says so.
//
// Views. A typed array that is called a view lies in the module's memory. It is valid until the next call of any kind on this
// module: read it at once, or copy it with slice(). A call that needs memory detaches every older view (its length is then 0).

export type Vector = ArrayLike<number> & Iterable<number>; // x, y, z
export type Quaternion = ArrayLike<number> & Iterable<number>; // x, y, z, w of length 1

export interface LoadOptions {
  /** Whether to take the build with vectors; by default where the host has them. Both give the same bits. */
  simd?: boolean;
  /** The bytes of the module, where neither fetch nor the file system finds `cairn.wasm` beside `cairn.mjs`. */
  wasm?: BufferSource;
}

/** Loads the module anew: what one call returns shares no memory with what another does. Takes WebAssembly exceptions. */
export function load(options?: LoadOptions): Promise<Cairn>;

export class CairnError extends Error {}

export interface Cairn {
  readonly version: string;
  readonly simd: boolean;
  /** Reads the bytes of a `.cairn` file; every one of them is checked. `name` begins the sentence of a failure. */
  readTree(bytes: Uint8Array, name?: string): Tree;
  makeShape(tree: Tree, options?: ShapeOptions): Shape;
  makeWorld(options?: WorldOptions): World;
  /** Bytes of WebAssembly memory that the module holds; it never shrinks. */
  memoryBytes(): number;
}

/** A certified sphere-tree. Lengths are in the mesh's unit, places in the mesh's frame. Shapes keep what they need of it. */
export interface Tree {
  readonly depth: number; // levels below the root
  readonly nodes: number;
  readonly leaves: number;
  readonly levelMeshes: number;
  readonly memoryBytes: number;
  readonly volume: number;
  readonly centerOfMass: readonly number[];
  readonly inertiaPerMass: readonly number[]; // about the centre of mass, nine numbers, row by row
  /** The same tree without what is below so many levels: coarser and cheaper, and certified as well. */
  cut(depth: number): Tree; // 1 to 255
  /** The bytes of its file: those that were read. */
  bytes(): Uint8Array;
  /** The mesh it covers: x, y, z a vertex. A copy, as the next two are. */
  vertices(): Float32Array;
  /** Three indices a triangle, counter-clockwise seen from outside. */
  triangles(): Uint32Array;
  /** Spheres of a level, and leaves above it: x, y, z, radius, certified error. */
  spheres(level: number): Float32Array; // 0 to 255
  free(): void;
}

export interface ShapeOptions {
  scale?: number; // metres of the mesh's unit, 1e-6 to 1e6; 1. The shape's size is then 0.0001 to 100,000 m
  /** What a body turns about; 'mesh' is for bodies that do not move. Poses are always of the mesh's frame. */
  frame?: 'principalAxes' | 'mesh';
  /** How far contacts may be off, as a fraction of the smaller body, where the tree has level meshes: 0 to 1; 0. */
  maxContactError?: number;
}

/** What bodies of one tree share. Bodies keep it alive, so it may be freed before them. */
export interface Shape {
  readonly scale: number;
  readonly size: number; // diagonal of the mesh's box
  free(): void;
}

/** Limits of the narrow phase of a step; what is left out is no limit. */
export interface Budget {
  /** Reproducible; 0 to 9e15, rounded down. */
  operations?: number;
  /** By performance.now(), which browsers round: to 5 microseconds in isolated pages, else to 100. 0 to 1e9. */
  microseconds?: number;
}

/** What a pair answers whose budget is spent; see docs/budgets.md of Cairn. */
export type Unresolved = 'guard' | 'repel' | 'ignore' | 'compensate';

export interface WorldOptions {
  gravity?: Vector; // each -10,000 to 10,000; 0, -9.81, 0
  timeStep?: number; // 0.00001 to 1; 1/60
  iterations?: number; // of the contact solver, 1 to 1000; 10
  budget?: Budget | null;
  unresolved?: Unresolved; // guard
  /** Where refinement ends: at the meshes, or at the tree's leaves. */
  finest?: 'triangles' | 'leaves';
}

export interface Material {
  friction?: number; // 0 to 100; 0.5. Those of both sides are multiplied
  restitution?: number; // 0 to 1; 0
}

export interface Placement {
  position?: Vector;
  rotation?: Quaternion;
}

export interface BodyOptions extends Material, Placement {
  mass?: number; // 1e-6 to 1e9, or 0 for what does not move; 1
  linearVelocity?: Vector; // of the centre of mass, each -10,000 to 10,000
  angularVelocity?: Vector; // rad/s, each -10,000 to 10,000
}

/** Statistics of the narrow phase in the last step; fields as in Cairn's StepStatistics. */
export interface StepStatistics {
  operations: number;
  microseconds: number; // as elapsedMicroseconds: there is no clock of CPU time
  elapsedMicroseconds: number; // of the narrow phase
  deadlineMicroseconds: number | null;
  missedByMicroseconds: number;
  pairs: number;
  nonFinitePairs: number;
  unresolvedPairs: number;
  contacts: number;
  exactContacts: number;
  manifolds: number;
  worstErrorFraction: number; // certified, of the smaller body's size
  meanErrorFraction: number;
  worstSeenError: number;
  meanSeenError: number;
}

/** Bodies have numbers from 0 on, which removed bodies leave to new ones. */
export interface World {
  readonly timeStep: number;
  setGravity(gravity: Vector): void;
  setIterations(iterations: number): void;
  setBudget(budget: Budget | null): void;
  setUnresolved(policy: Unresolved): void;
  setFinest(finest: 'triangles' | 'leaves'): void;
  /**
   * Solid is where the product of a point with `normal` is below `offset`. The normal's length is 0.001 to 1000; the offset, also
   * over that length, -1e6 to 1e6.
   */
  addPlane(normal: Vector, offset: number, material?: Material): void;
  /** Half extents are 0.0001 to 1e6 m. */
  addBox(halfExtents: Vector, options?: Material & Placement): void;
  addBody(shape: Shape, options?: BodyOptions): number;
  /** Wakes bodies that touch it. */
  removeBody(body: number): void;
  setPose(body: number, position: Vector, rotation?: Quaternion): void;
  setVelocity(body: number, linear?: Vector, angular?: Vector): void;
  /** Pulls a point of the body (mesh frame, metres) to a place in the world, in every step until `point` is null. */
  drag(body: number, point: Vector | null, target?: Vector): void;
  release(body: number): void;
  /** One step of the world's time step. */
  step(): void;
  statistics(): StepStatistics;
  /**
   * CONTACT_STRIDE numbers a contact of the last step: point (3, world), normal (3, unit, from b to a), depth (positive where
   * surfaces overlap), certified error of the pair, a, b, impulse along the normal (N s), 1 where the pair was resolved, 0 where its budget ended.
   * a and b are bodies; planes and boxes are negative. A view.
   */
  contacts(): Float32Array;
  /** Seven numbers a body: position and rotation of its mesh's frame. NaN for removed ones. A view. */
  transforms(): Float32Array;
  /** Six numbers a body: linear and angular velocity. A view. */
  velocities(): Float32Array;
  /** One number a body: 1 asleep, 0 awake, 2 removed. A view. */
  asleep(): Uint8Array;
  /** Sixteen hexadecimal digits over where everything is and how it moves, in the order it was added. */
  stateHash(): string;
  free(): void;
}

export const CONTACT_STRIDE: 12;

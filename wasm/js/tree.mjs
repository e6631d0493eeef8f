// SPDX-License-Identifier: Zlib
import { kRanges, numberIn, optionsOf, placeIn, wholeIn } from './ranges.mjs';

const frames = ['principalAxes', 'mesh'];
const numberNames = ['depth', 'nodes', 'leaves', 'levelMeshes', 'memoryBytes', 'volume'];

/** A certified sphere-tree; index.d.ts says what its members mean. */
export class Tree {
  #memory;
  #handle;

  constructor(memory, handle) {
    this.#memory = memory;
    this.#handle = handle;
    const numbers = memory.list(Float64Array, memory.exports.cairn_tree_numbers(handle));
    numberNames.forEach((name, i) => (this[name] = numbers[i]));
    this.centerOfMass = [...numbers.slice(6, 9)];
    this.inertiaPerMass = [...numbers.slice(9, 18)];
    Object.freeze(this);
  }

  /** What a tree is called by in the module of `memory`. */
  static handleIn(memory, tree) {
    if (!(#handle in tree)) throw new TypeError('this is no tree; give what readTree or cut returned');
    if (tree.#memory !== memory) throw new TypeError('this tree is of another module; read it with the one that takes it');
    return tree.#own;
  }

  get #own() {
    if (!this.#handle) throw new TypeError('this tree was freed');
    return this.#handle;
  }

  cut(depth) {
    const { exports } = this.#memory;
    const levels = wholeIn(kRanges.cut, depth, 'cut: the number of levels');
    return new Tree(this.#memory, this.#memory.check(exports.cairn_tree_cut(this.#own, levels)));
  }

  #copy(Kind, call, ...more) {
    return this.#memory.list(Kind, this.#memory.exports[call](this.#own, ...more)).slice();
  }
  bytes() {
    return this.#copy(Uint8Array, 'cairn_tree_bytes');
  }
  vertices() {
    return this.#copy(Float32Array, 'cairn_tree_vertices');
  }
  triangles() {
    return this.#copy(Uint32Array, 'cairn_tree_triangles');
  }
  spheres(level) {
    return this.#copy(Float32Array, 'cairn_tree_spheres', wholeIn(kRanges.level, level, 'spheres: the level'));
  }

  free() {
    this.#memory.exports.cairn_tree_free(this.#handle);
    this.#handle = 0;
  }
}

/** What bodies of one tree, scale and frame share. */
export class Shape {
  #memory;
  #handle;

  constructor(memory, tree, options) {
    const where = 'makeShape';
    const { scale = 1, frame = 'principalAxes', maxContactError = 0 } = optionsOf(options, where, 'scale: 0.001');
    const ofMesh = placeIn(frames, frame, 'frame');
    numberIn(kRanges.scale, scale, `${where}: the scale`);
    numberIn(kRanges.maxContactError, maxContactError, `${where}: the maxContactError`);
    this.#memory = memory;
    this.#handle = memory.check(memory.exports.cairn_shape_make(Tree.handleIn(memory, tree), scale, ofMesh, maxContactError));
    this.scale = scale;
    this.size = memory.exports.cairn_shape_size(this.#handle);
    this.#orFree(() => numberIn(kRanges.size, this.size, `${where}: the shape's size`));
    Object.freeze(this);
  }

  // What is refused half-way leaves nothing.
  #orFree(call) {
    try {
      call();
    } catch (error) {
      this.free();
      throw error;
    }
  }

  /** What a shape is called by in the module of `memory`. */
  static handleIn(memory, shape) {
    if (!(#handle in shape)) throw new TypeError('this is no shape; give what makeShape returned');
    if (shape.#memory !== memory) throw new TypeError('this shape is of another module; make it with the one of the world');
    if (!shape.#handle) throw new TypeError('this shape was freed');
    return shape.#handle;
  }

  free() {
    this.#memory.exports.cairn_shape_free(this.#handle);
    this.#handle = 0;
  }
}

// SPDX-License-Identifier: Zlib

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
    return new Tree(this.#memory, this.#memory.check(exports.cairn_tree_cut(this.#own, depth)));
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
    return this.#copy(Float32Array, 'cairn_tree_spheres', level);
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

  constructor(memory, tree, { scale = 1, frame = 'principalAxes', maxContactError = 0 } = {}) {
    const frames = ['principalAxes', 'mesh'];
    if (!frames.includes(frame)) throw new TypeError(`there is no frame '${frame}'; give ${frames.join(' or ')}`);
    this.#memory = memory;
    const made = memory.exports.cairn_shape_make(Tree.handleIn(memory, tree), scale, frame === 'mesh' ? 1 : 0, maxContactError);
    this.#handle = memory.check(made);
    this.scale = scale;
    this.size = memory.exports.cairn_shape_size(this.#handle);
    Object.freeze(this);
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

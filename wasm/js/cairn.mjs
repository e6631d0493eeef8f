// SPDX-License-Identifier: Zlib
import { hasSimd, instantiate } from './module.mjs';
import { Shape, Tree } from './tree.mjs';
import { World } from './world.mjs';

export { CairnError } from './module.mjs';

/** Numbers of one contact in `World.contacts()`. */
export const CONTACT_STRIDE = 12;

/** Loads the module once for each call; index.d.ts says what is in it. */
export async function load({ simd = hasSimd(), wasm } = {}) {
  const memory = await instantiate(simd, wasm);
  return Object.freeze({
    version: memory.text(memory.exports.cairn_version()),
    simd,
    readTree(bytes, name = 'the tree') {
      if (!ArrayBuffer.isView(bytes) || bytes.BYTES_PER_ELEMENT !== 1) throw new TypeError(`${name}: the bytes are no Uint8Array; give one`);
      const handle = memory.withBytes(bytes, (at, count) => memory.exports.cairn_tree_read(at, count));
      return new Tree(memory, memory.check(handle, name));
    },
    makeShape: (tree, options) => new Shape(memory, tree, options),
    makeWorld: (options) => new World(memory, options),
    memoryBytes: () => memory.exports.memory.buffer.byteLength,
  });
}

// SPDX-License-Identifier: Zlib
//
// The package that is tested, and trees to test it with. CAIRN_PACKAGE names its folder, CAIRN_GOLDEN_TREES that of the golden
// heap's trees.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const root = resolve(import.meta.dirname, '../..');
const folder = resolve(process.env.CAIRN_PACKAGE ?? `${root}/out/wasm/cairn-collision`);
const trees = resolve(process.env.CAIRN_GOLDEN_TREES ?? `${root}/out/wasm/golden`);

export const { load, CairnError, CONTACT_STRIDE } = await import(pathToFileURL(`${folder}/cairn.mjs`));
export const builds = { vectors: await load({ simd: true }), plain: await load({ simd: false }) };
export const described = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
export const bytesOfBuild = readFileSync(`${folder}/cairn.wasm`);
export const rock = readFileSync(`${root}/tests/data/rock.cairn`);
export const round = readFileSync(`${trees}/round.cairn`);
export const square = readFileSync(`${trees}/square.cairn`);

/** How the golden heap ends natively in single precision, as the C++ tests have it. */
export const goldenHash = readFileSync(`${root}/tests/support/walled_heap.h`, 'utf8').match(/0x([0-9a-f]{16}) : 0x/)[1];

/** A world with gravity along -z and the ground z = 0. */
export function worldOn(cairn, options) {
  const world = cairn.makeWorld({ gravity: [0, 0, -9.81], ...options });
  world.addPlane([0, 0, 1], 0);
  return world;
}

export function steps(world, count) {
  for (let i = 0; i < count; ++i) world.step();
  return world;
}

// SPDX-License-Identifier: Zlib
//
// As heap_time.cpp, by the npm package: node heap_time.mjs PACKAGE vectors|plain TREE BODIES STEPS OPERATIONS
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, build, file, bodies, steps, operations] = process.argv.slice(2);
const { load } = await import(pathToFileURL(resolve(folder, 'cairn.mjs')));
const cairn = await load({ simd: build === 'vectors' });

let state = 1n;
function random() {
  state = BigInt.asUintN(64, state * 6364136223846793005n + 1442695040888963407n);
  return Number(state >> 32n) / 2147483648 - 1;
}

function rotation() {
  const q = [random(), random(), random(), random()];
  const length = Math.sqrt(q.reduce((sum, part) => sum + part * part, 0));
  return q.map((part) => part / length);
}

const shape = cairn.makeShape(cairn.readTree(readFileSync(file), file));

function heapOf(count) {
  const world = cairn.makeWorld({ gravity: [0, 0, -9.81], budget: Number(operations) > 0 ? { operations: Number(operations) } : null });
  world.addPlane([0, 0, 1], 0);
  for (const normal of [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]) world.addPlane(normal, -2 * shape.size);
  state = 1n;
  for (let i = 0; i < count; ++i) {
    const cell = [(i % 3) - 1, (Math.trunc(i / 3) % 3) - 1, Math.trunc(i / 9) + 1];
    world.addBody(shape, { position: cell.map((part) => part * shape.size), rotation: rotation() });
  }
  return world;
}

/// CPU milliseconds of each step.
function run(world, count) {
  return Array.from({ length: count }, () => {
    const began = process.cpuUsage();
    world.step();
    const { user, system } = process.cpuUsage(began);
    return (user + system) / 1000;
  });
}

// The module is compiled while it runs at first; that is told by nobody's steps.
const first = heapOf(30);
run(first, 150);
first.free();

const world = heapOf(Number(bodies));
const cpuMs = run(world, Number(steps));
console.log(JSON.stringify({ hash: world.stateHash(), cpuMs }));

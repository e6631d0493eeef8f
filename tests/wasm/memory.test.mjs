// SPDX-License-Identifier: Zlib
//
// Little memory: every call answers, with a sentence where there is not enough.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bytesOfBuild, CairnError, load, rock } from './package.mjs';

function readNumber(bytes, at) {
  let [value, shift] = [0, 0];
  for (;;) {
    const byte = bytes[at++];
    value |= (byte & 127) << shift;
    if (byte < 128) return [value, at];
    shift += 7;
  }
}

function writtenNumber(value) {
  const bytes = [];
  for (; value > 127; value >>>= 7) bytes.push((value & 127) | 128);
  return [...bytes, value];
}

/// The module with another memory: so many pages at first, and at most so many.
function withMemory(bytes, least, most) {
  for (let at = 8; ; ) {
    const id = bytes[at];
    const [size, begin] = readNumber(bytes, at + 1);
    if (id !== 5) {
      at = begin + size;
      continue;
    }
    const section = [1, 1, ...writtenNumber(least), ...writtenNumber(most)];
    return Buffer.concat([bytes.subarray(0, at + 1), Buffer.from([...writtenNumber(section.length), ...section]), bytes.subarray(begin + size)]);
  }
}

// Static data and the stack of 1 MB: the module does not start with less.
const kLeast = 24;
const loadWith = (most) => load({ simd: true, wasm: withMemory(bytesOfBuild, kLeast, most) });

/// The calls of a heap in the order they are made; each is asked for by its place, and leaves what it makes in `made`.
function callsOf(cairn, made, { bodies, crowded = false }) {
  const walls = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]];
  const place = (i) => (crowded ? [0, 0, 1] : [(i % 3) / 2, (i % 2) / 2, made.shape.size * (1 + i / 2)]);
  return [
    () => (made.tree = cairn.readTree(rock, 'rock.cairn')),
    () => (made.shape = cairn.makeShape(made.tree)),
    () => (made.world = cairn.makeWorld({ gravity: [0, 0, -9.81] })),
    () => made.world.addPlane([0, 0, 1], 0),
    ...walls.map((normal) => () => made.world.addPlane(normal, -1.5 * made.shape.size)),
    ...Array.from({ length: bodies }, (_, i) => () => made.world.addBody(made.shape, { position: place(i) })),
    ...Array.from({ length: crowded ? 1 : 40 }, () => () => made.world.step()),
    () => made.world.contacts(),
    () => made.world.statistics(),
    () => made.world.stateHash(),
  ];
}

const isWant = (error) => error instanceof CairnError && /^there is not enough memory; free .*used$/.test(error.message);
const isBroken = (error) => error instanceof CairnError && /^this world was broken off .*; load Cairn anew$/.test(error.message);

/// Makes the calls; the sentence of the first that fails, or null, with what was made.
function run(cairn, heap) {
  const made = {};
  for (const [k, call] of callsOf(cairn, made, heap).entries()) {
    try {
      made.last = call();
    } catch (error) {
      assert.ok(isWant(error), `call ${k}: ${error.stack}`);
      return { ...made, error };
    }
  }
  return { ...made, error: null };
}

/// After a failure a world answers every call, or refuses every call with the same sentence.
function stateOf(world, shape) {
  const calls = [() => world.transforms(), () => world.contacts(), () => world.asleep(), () => world.velocities(), () => world.statistics(),
    () => world.stateHash(), () => world.setFinest('leaves'), () => world.setGravity([0, 0, -1])];
  const growing = [() => world.addBody(shape), () => world.addPlane([1, 0, 0], -9), () => world.setBudget(null), () => world.step()];
  try {
    world.transforms();
  } catch {
    for (const call of [...calls, ...growing]) assert.throws(call, isBroken, String(call));
    return 'broken';
  }
  for (const call of calls) call();
  for (const call of growing) {
    try {
      call();
    } catch (error) {
      assert.ok(isWant(error) || isBroken(error), error.message);
    }
  }
  return 'usable';
}

test('with whatever memory, every call answers, and a world goes on', async () => {
  const seen = { usable: 0, broken: 0, none: 0 };
  const { last: hash } = run(await load({ simd: true }), { bodies: 60 });
  for (let most = kLeast; ; most += 5) {
    assert.ok(most < 400, 'at some size there is enough');
    const cairn = await loadWith(most);
    const { tree, shape, world, error, last } = run(cairn, { bodies: 60 });
    if (!error) {
      assert.equal(last, hash, 'little memory changes no bits');
      break;
    }
    seen[world ? stateOf(world, shape) : 'none'] += 1;
    for (const one of [world, shape, tree]) one?.free();
    assert.ok(cairn.readTree(rock).nodes > 0, 'what was freed is there again');
  }
  assert.ok(seen.usable > 0 && seen.none > 0 && seen.broken === 0, JSON.stringify(seen));
});

test('a world that a crowd broke off says so in every call, and the module goes on', async () => {
  for (const most of [140, 200, 260]) {
    const cairn = await loadWith(most);
    const { tree, shape, world } = run(cairn, { bodies: 60, crowded: true });
    assert.equal(stateOf(world, shape), 'broken');
    for (const one of [world, shape]) one.free();
    assert.ok(tree.vertices().length > 0);
    assert.throws(() => cairn.readTree(rock.subarray(0, 99)), CairnError);
  }
});

test('a world that lacked memory goes on with the same bits when some was freed', async () => {
  const { last: hash } = run(await load({ simd: true }), { bodies: 30 });
  const cairn = await loadWith(150);
  const ballast = [cairn.makeWorld()];
  const made = {};
  let failures = 0;
  for (const call of callsOf(cairn, made, { bodies: 30 }))
    try {
      made.last = call();
    } catch (error) {
      assert.ok(isWant(error), error.message);
      failures += 1;
      ballast.pop().free();
      made.last = call();
    }
  assert.equal(failures, 1);
  assert.equal(made.last, hash);
});

test('worlds that are refused hold no memory', async () => {
  const cairn = await loadWith(130);
  const worlds = [];
  assert.throws(() => { for (;;) worlds.push(cairn.makeWorld()); }, isWant);
  for (let i = 0; i < 50; ++i) assert.throws(() => cairn.makeWorld(), isWant);
  worlds.pop().free();
  cairn.makeWorld();
});

test('a call that is broken off in the module is told, and so is every later one', async () => {
  const cairn = await load();
  const world = cairn.makeWorld({ budget: { microseconds: 1000 } });
  world.step();
  const { now } = performance;
  performance.now = () => {
    throw new RangeError('the clock fell down');
  };
  try {
    assert.throws(() => world.step(), (e) => e instanceof CairnError && /^Cairn broke off in cairn_world_step \(the clock fell down\) and .*; load it anew$/.test(e.message));
  } finally {
    performance.now = now;
  }
  for (const call of [() => world.step(), () => world.transforms(), () => cairn.makeWorld(), () => cairn.readTree(rock), () => world.free()])
    assert.throws(call, /load it anew/);
  (await load()).makeWorld().step();
});

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes of the comparison: what starts linked is linked, nothing starts inside another, and the judge knows known depths.
//   node --test scenes_test.mjs, with the judge's program in CAIRN_JUDGE
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { makeBody } from '../../demos/engines/bodies.mjs';
import { linkingNumber } from '../../demos/showdown/linking.mjs';
import { countLost, halfWidthOf, kScenes, pitBoxes, pitFaces, randomOf } from '../../demos/showdown/scenes.mjs';

const kJudge = process.env.CAIRN_JUDGE;
const kUpright = [0, 0, 0, 1];
const kQuarter = [Math.SQRT1_2, 0, 0, Math.SQRT1_2]; // about x

function judge(question) {
  const folder = mkdtempSync(join(tmpdir(), 'cairn-judge-'));
  try {
    const file = join(folder, 'frames.json');
    writeFileSync(file, JSON.stringify(question));
    return JSON.parse(execFileSync(kJudge, [file], { encoding: 'utf8' }));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const circle = Array.from({ length: 40 }, (_, k) => [Math.cos((k * Math.PI) / 20), Math.sin((k * Math.PI) / 20), 0]);

test('circles are linked where one goes through the other', () => {
  const still = [0, 0, 0, ...kUpright];
  for (const [x, linked] of [[0.5, 1], [1, 1], [1.9, 1], [2.1, 0], [5, 0]]) assert.equal(Math.abs(linkingNumber(circle, still, [x, 0, 0, ...kQuarter])), linked, `${x} apart`);
  assert.equal(linkingNumber(circle, still, [0, 0, 0.1, ...kUpright]), 0, 'one above the other');
});

const posesOf = (scene, bodies, seed) => kScenes[scene].start(bodies, randomOf(seed)).flatMap(({ position, rotation }) => [...position, ...rotation]);

for (const scene of Object.keys(kScenes)) {
  test(`${scene}: starts are those of the seed, in the pit`, () => {
    for (const bodies of [20, 60, 100, 300]) {
      const poses = posesOf(scene, bodies, 1);
      assert.equal(poses.length, 7 * bodies);
      assert.deepEqual(posesOf(scene, bodies, 1), poses);
      assert.notDeepEqual(posesOf(scene, bodies, 2), poses);
      assert.equal(countLost(poses, halfWidthOf(bodies)), 0);
      assert.equal(kScenes[scene].apart?.(poses) ?? 0, 0, 'all links are linked');
    }
  });
}

for (const scene of ['chains', 'hooks', 'bowls']) {
  test(`${scene}: nothing starts inside another body or the pit`, { skip: !kJudge && 'CAIRN_JUDGE names no judge' }, () => {
    const { vertices, indices } = makeBody(kScenes[scene].model);
    const [{ depth, pitDepth }] = judge({ vertices: [...vertices], indices: [...indices], faces: pitFaces(halfWidthOf(60)), frames: [posesOf(scene, 60, 1)] });
    assert.deepEqual([depth.max, pitDepth.max], [0, 0]);
  });
}

test('a pit of boxes has the faces that bodies are counted and judged by', () => {
  const halfWidth = 2;
  const inner = pitBoxes(halfWidth).map(({ halfExtents, position }) => position.map((p, axis) => Math.abs(p) - halfExtents[axis]));
  assert.ok(inner.slice(1).every((gaps) => Math.max(gaps[0], gaps[2]) === halfWidth));
  assert.equal(pitBoxes(halfWidth)[0].position[1] + pitBoxes(halfWidth)[0].halfExtents[1], 0);
  assert.equal(countLost([halfWidth + 0.6, 1, 0, ...kUpright, 0, 1, 0, ...kUpright, 0, NaN, 0, ...kUpright], halfWidth), 2);
});

test('the judge knows the depth of cubes, their gap, and what is below the ground', { skip: !kJudge && 'CAIRN_JUDGE names no judge' }, () => {
  const vertices = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [(k & 1) - 0.5, ((k >> 1) & 1) - 0.5, ((k >> 2) & 1) - 0.5]);
  const indices = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  const size = Math.sqrt(3);
  const frame = (...places) => places.flatMap((place) => [...place, ...kUpright]);
  const [overlap, apart, sunk] = judge({
    vertices,
    indices,
    faces: [[0, 1, 0, 0]],
    frames: [frame([0, 9, 0], [0.9, 9.2, 0.3]), frame([0, 9, 0], [1.05, 9, 0]), frame([0, 0.4, 0])],
  });
  // Twice the judge's own tolerance of 0.05 % of size.
  const isNear = (is, should) => assert.ok(Math.abs(is * size - should) < 0.001 * size, `${is * size}, not ${should}`);
  isNear(overlap.depth.max, 0.1);
  assert.equal(overlap.gap.max, 0);
  assert.equal(apart.depth.pairs, 0);
  isNear(apart.gap.mean, 0.05);
  isNear(sunk.pitDepth.max, 0.1);
});

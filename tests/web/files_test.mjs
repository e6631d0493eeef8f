// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that the page reads and writes, and its start poses, without a browser.
//   node --test files_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Recorder, runOf, textOf } from '../../demos/web/page/recording.js';
import { boxesOf, pitFor, randomFrom, startOf } from '../../demos/web/page/scene_plan.js';
import { quantile, roundUp } from '../../demos/web/page/strip_chart.js';
import { placeAt, tracksOfGeoJson, tracksOfVtk } from '../../demos/web/page/trajectories.js';
import { vtkOfTwoRocks, geoJsonOfTwoRocks } from './samples.mjs';

function recorded(frames = 5) {
  const recorder = new Recorder('Cairn 0', ['ring', 'hook'], [1, 0, 1]);
  for (let step = 10; step < 10 + frames; ++step) recorder.add(step, Float32Array.from({ length: 21 }, (_, k) => Math.fround(step + k / 7)));
  return recorder;
}

test('a run that is saved and opened is the same, bit by bit', () => {
  const run = recorded().run();
  assert.deepEqual(runOf(textOf(run), ['hook', 'knot', 'ring']), run);
  assert.equal(run.times[0], 0);
});

test('a recording keeps the last minute', () => {
  const { frames, times } = recorded(4000).run();
  assert.equal(frames.length, 3600);
  assert.equal(frames.at(-1)[0], 4009);
  assert.ok(Math.abs(times.at(-1) - 59.983) < 0.01);
});

test('files that are no run are refused in one sentence', () => {
  const good = JSON.parse(textOf(recorded().run()));
  const known = ['ring', 'hook'];
  const wrong = {
    'not JSON': '{',
    'does not say so': JSON.stringify({ ...good, format: 'other' }),
    'does not say so, too': 'null',
    'version is 2': JSON.stringify({ ...good, version: 2 }),
    'swan is not on': JSON.stringify({ ...good, models: ['swan', 'hook'] }),
    'has no model': JSON.stringify({ ...good, bodies: [0, 1, 2] }),
    'do not rise': JSON.stringify({ ...good, times: [0, 1, 1, 2, 3] }),
    'cut short': JSON.stringify({ ...good, poses: good.poses.slice(0, -8) }),
    'not base64': JSON.stringify({ ...good, poses: '%%%' }),
    'is no number': JSON.stringify({ ...good, poses: Buffer.alloc(5 * 3 * 28, 0xff).toString('base64') }),
    'more than 5000': JSON.stringify({ ...good, bodies: Array(6000).fill(0) }),
  };
  for (const [why, text] of Object.entries(wrong)) assert.throws(() => runOf(text, known), new RegExp(why.replace(', too', '')), why);
});

test('trajectories of both formats lead the same way', () => {
  const [vtk, geo] = [tracksOfVtk(vtkOfTwoRocks), tracksOfGeoJson(geoJsonOfTwoRocks)];
  for (const { tracks, duration } of [vtk, geo]) {
    assert.equal(tracks.length, 2);
    assert.equal(duration, 2);
    // The map's z is up, and its first place is the middle of the picture.
    assert.deepEqual(tracks[0].places, [[0, 0, 0], [1, -1, -2], [2, -4, -3]]);
    assert.deepEqual(placeAt(tracks[0], 1), [1, -1, -2]);
    assert.deepEqual(placeAt(tracks[0], 1.5), [1.5, -2.5, -2.5]);
    assert.deepEqual(placeAt(tracks[0], 9), [2, -4, -3]);
    assert.deepEqual(placeAt(tracks[1], -1), tracks[1].places[0]);
  }
  assert.equal(geo.tracks[1].size, 0.75);
});

test('what are no trajectories are refused in one sentence', () => {
  const geo = (features) => JSON.stringify({ type: 'FeatureCollection', features });
  assert.throws(() => tracksOfGeoJson('['), /not JSON/);
  assert.throws(() => tracksOfGeoJson('{}'), /no list of features/);
  assert.throws(() => tracksOfGeoJson(geo([])), /no line/);
  assert.throws(() => tracksOfGeoJson(geo([{ geometry: { type: 'Point', coordinates: [1, 2] } }])), /no line/);
  assert.throws(() => tracksOfGeoJson(geo([{ geometry: { type: 'LineString', coordinates: [[0, 0], [0, 'x']] } }])), /no number/);
  assert.throws(() => tracksOfVtk('# vtk DataFile Version 3.0\nx\nBINARY\n'), /ASCII/);
  assert.throws(() => tracksOfVtk(vtkOfTwoRocks.replace('POINTS', 'PLACES')), /no POINTS/);
  assert.throws(() => tracksOfVtk(vtkOfTwoRocks.replace('3 0 1 2', '3 0 1 99')), /leads nowhere/);
  assert.throws(() => tracksOfVtk(vtkOfTwoRocks.replace('3 0 1 2', '3 0 2 1')), /do not rise/);
});

test('bodies start in the pit, apart from each other, and alike every time', () => {
  for (const count of [1, 10, 100, 300]) {
    const { pit, bodies } = startOf({ count, models: [0, 1, 2], seed: 1 });
    assert.deepEqual(startOf({ count, models: [0, 1, 2], seed: 1 }).bodies, bodies);
    assert.equal(bodies.length, count);
    bodies.forEach(({ position, rotation }, k) => {
      // Bodies are a metre across at most, but the ones beside a wall may not touch it: half a metre of room.
      for (const c of [0, 2]) assert.ok(Math.abs(position[c]) + 0.5 < pit.half + 0.05, `${position}`);
      assert.ok(position[1] >= 0.5 && position[1] < pit.height);
      assert.ok(Math.abs(Math.hypot(...rotation) - 1) < 1e-12);
      for (const other of bodies.slice(0, k)) assert.ok(Math.hypot(...other.position.map((c, i) => c - position[i])) > 1);
    });
  }
});

test('the pit is closed: walls meet the ground and each other', () => {
  const pit = pitFor(100);
  const boxes = boxesOf(pit);
  const inside = ([x, y, z]) => boxes.some(({ halfExtents, position }) => [x, y, z].every((c, k) => Math.abs(c - position[k]) <= halfExtents[k] + 1e-12));
  const random = randomFrom(3);
  for (let k = 0; k < 2000; ++k) {
    const [a, b] = [2 * random() - 1, random()];
    const edge = pit.half + 0.01;
    for (const place of [[edge, b * pit.height, a * edge], [-edge, b * pit.height, a * edge], [a * edge, b * pit.height, edge], [a * edge, b * pit.height, -edge], [a * edge, -0.01, edge * (2 * b - 1)]]) {
      assert.ok(inside(place), `a hole at ${place}`);
    }
    assert.ok(!inside([a * (pit.half - 0.01), 0.01 + b * (pit.height - 0.01), (2 * random() - 1) * (pit.half - 0.01)]));
  }
});

test('scales end at round numbers, and quantiles are values', () => {
  assert.deepEqual([0.9, 1, 1.1, 3, 5.1, 70, 300].map(roundUp), [1, 1, 2, 5, 10, 100, 500]);
  assert.equal(quantile([], 0.5), null);
  assert.equal(quantile([3, 1, 2], 0.99), 3);
  assert.equal(quantile([3, 1, 2], 0), 1);
});

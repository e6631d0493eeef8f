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
import { commandOf, stepOf } from '../../demos/web/page/key_names.js';
import { vtkOfTwoRocks, geoJsonOfTwoRocks } from './samples.mjs';

function recorded(frames = 5) {
  const recorder = new Recorder('Cairn 0', ['ring', 'hook'], [1, 0, 1]);
  const poseAt = (step, k) => [step + k / 7, step, k, 0.48, 0.6, 0, 0.64];
  for (let step = 10; step < 10 + frames; ++step) recorder.add(step, Float32Array.from([0, 1, 2].flatMap((k) => poseAt(step, k))));
  return recorder;
}

/// The same five frames, one number of the first pose changed.
function posesWith(place, value) {
  const poses = Float32Array.from(recorded().run().frames.flatMap((frame) => [...frame]));
  poses[place] = value;
  return Buffer.from(poses.buffer).toString('base64');
}

test('a run that is saved and opened is the same, bit by bit', () => {
  const run = recorded().run();
  assert.deepEqual(runOf(textOf(run), ['hook', 'knot', 'ring']), run);
  assert.equal(run.times[0], 0);
});

test('a body that fell out of the world does not spoil the run that is saved', () => {
  const run = recorded().run();
  run.frames[2].set([0, -3e7, NaN, NaN, 0, 0, 1], 7);
  const again = runOf(textOf(run), ['ring', 'hook']);
  assert.deepEqual([...again.frames[2].subarray(7, 14)], [0, -1e6, 1e6, 0, 0, 0, 1]);
  assert.deepEqual(again.frames[1], run.frames[1]);
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
    'more models than': JSON.stringify({ ...good, models: Array(9999).fill('ring') }),
    'has no model': JSON.stringify({ ...good, bodies: [0, 1, 2] }),
    'do not rise': JSON.stringify({ ...good, times: [0, 1, 1, 2, 3] }),
    'cut short': JSON.stringify({ ...good, poses: good.poses.slice(0, -8) }),
    'not base64': JSON.stringify({ ...good, poses: '%%%' }),
    'is no number': JSON.stringify({ ...good, poses: Buffer.alloc(5 * 3 * 28, 0xff).toString('base64') }),
    'farther than 1000 km': JSON.stringify({ ...good, poses: posesWith(1, 3e38) }),
    'farther than 1000 km, too': JSON.stringify({ ...good, poses: posesWith(0, -1.1e6) }),
    'no unit quaternion': JSON.stringify({ ...good, poses: posesWith(6, 40) }),
    'longer than a day': JSON.stringify({ ...good, times: [0, 1, 2, 3, 1e300] }),
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

test('many trajectories are read, and long ones', () => {
  const line = (k) => ({ geometry: { type: 'LineString', coordinates: [[k, 0, 0], [k + 1, 0, 0]] }, properties: { time_s: 2 } });
  const many = tracksOfGeoJson(JSON.stringify({ type: 'FeatureCollection', features: Array.from({ length: 200000 }, (_, k) => line(k)) }));
  assert.equal(many.tracks.length, 200000);
  assert.equal(many.duration, 2);
});

test('what are no trajectories are refused in one sentence', () => {
  const geo = (features) => JSON.stringify({ type: 'FeatureCollection', features });
  assert.throws(() => tracksOfGeoJson('['), /not JSON/);
  assert.throws(() => tracksOfGeoJson('{}'), /no list of features/);
  assert.throws(() => tracksOfGeoJson(geo([])), /no line/);
  assert.throws(() => tracksOfGeoJson(geo([{ geometry: { type: 'Point', coordinates: [1, 2] } }])), /no line/);
  assert.throws(() => tracksOfGeoJson(geo([{ geometry: { type: 'LineString', coordinates: [[0, 0], [0, 'x']] } }])), /no number/);
  const far = geo([{ geometry: { type: 'LineString', coordinates: [[0, 0, 0], [0, 3e38, 0]] } }]);
  assert.throws(() => tracksOfGeoJson(far), /farther than 1000 km/);
  assert.throws(() => tracksOfVtk(vtkOfTwoRocks.replace('101 202 49', '101 2e200 49')), /farther than 1000 km/);
  const slow = geo([{ geometry: { type: 'LineString', coordinates: [[0, 0], [1, 1]] }, properties: { time_s: 1e300 } }]);
  assert.throws(() => tracksOfGeoJson(slow), /longer than a day/);
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

test('keys mean the same with caps lock', () => {
  for (const [key, command] of Object.entries({ d: 'drop', D: 'drop', P: 'pause', c: 'show-contacts', F: 'frame' })) assert.equal(commandOf({ key }), command);
  for (const key of ['x', 'toString', 'Enter', undefined]) assert.equal(commandOf({ key }), null);
  // N goes on with caps lock too; Shift turns round, whatever letter comes of it.
  for (const [key, shiftKey, step] of [['n', false, 1], ['N', false, 1], ['N', true, -1], ['n', true, -1], ['m', false, 0], [undefined, false, 0]]) assert.equal(stepOf({ key, shiftKey }), step);
});

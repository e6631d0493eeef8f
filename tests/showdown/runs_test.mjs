// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs that are resumed are of the same code; who is too slow or nowhere is told, not passed over.
//   node --test runs_test.mjs, with the judge's program in CAIRN_JUDGE
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { appendFileSync, cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, test } from 'node:test';
import { makeBody } from '../../demos/engines/bodies.mjs';
import { kContestants, kQuoted, kUsual } from '../../demos/showdown/contestants.mjs';
import { drawFigure, quoteOf, summaryOf, tableOf } from '../../demos/showdown/figures.mjs';
import { fingerprintOf } from '../../demos/showdown/fingerprint.mjs';
import { keptOr } from '../../demos/showdown/kept_runs.mjs';
import { figuresOf, makePatience } from '../../demos/showdown/measured.mjs';
import { countLost, halfWidthOf, kScenes, pitFaces, randomOf } from '../../demos/showdown/scenes.mjs';

const kJudge = process.env.CAIRN_JUDGE;
const demos = resolve(import.meta.dirname, '../../demos');
const folder = mkdtempSync(join(tmpdir(), 'cairn-runs-'));
after(() => rmSync(folder, { recursive: true }));

/// All that a run depends on, copied, so that it can be changed.
function copies(name) {
  const at = (part) => join(folder, name, part);
  for (const part of ['showdown', 'engines']) cpSync(join(demos, part), at(part), { recursive: true, filter: (path) => !path.includes('node_modules') });
  mkdirSync(at('cairn'));
  for (const file of ['cairn/cairn.wasm', 'cairn/world.mjs', 'judge', 'mesh', 'tree', 'hulls']) writeFileSync(at(file), file);
  return { places: { showdown: at('showdown'), engines: at('engines'), cairn: at('cairn'), judge: at('judge') }, model: { mesh: at('mesh'), tree: at('tree'), hulls: at('hulls') }, at };
}

const settings = { scene: 'heap', bodies: 60, seed: 1, steps: 300 };
const names = ['cairn', 'rapier-mesh', 'jolt-64', 'havok-hulls'];
const fingerprints = ({ places, model }, changed = {}) => names.map((name) => fingerprintOf(places, kContestants[name], model, { ...settings, ...changed }));

test('a fingerprint changes with whatever decides a run, and with nothing of another engine', () => {
  const whole = copies('whole');
  const before = fingerprints(whole);
  assert.equal(new Set(before).size, names.length);
  assert.deepEqual(fingerprints(copies('again')), before, 'folders have no part in it');
  const kAll = [0, 1, 2, 3];
  const cases = [
    ['cairn/cairn.wasm', [0]], ['cairn/world.mjs', [0]], ['engines/cairn.mjs', [0]], ['tree', [0]], ['engines/rapier.mjs', [1]], ['engines/jolt.mjs', [2]],
    ['engines/havok.mjs', [3]], ['engines/package-lock.json', [1, 2, 3]], ['hulls', [1, 2, 3]], ['engines/common.mjs', kAll], ['engines/mass.mjs', kAll],
    ['showdown/scenes.mjs', kAll], ['showdown/linking.mjs', kAll], ['showdown/run.mjs', kAll], ['showdown/measured.mjs', kAll], ['showdown/one_run.mjs', kAll],
    ['judge', kAll], ['mesh', kAll], ['showdown/figures.mjs', []], ['showdown/README.md', []],
  ];
  for (const [file, who] of cases) {
    const changed = copies(`changed-${file.replaceAll('/', '-')}`);
    appendFileSync(changed.at(file), ' ');
    const now = fingerprints(changed);
    assert.deepEqual(kAll.filter((k) => now[k] !== before[k]), who, file);
  }
  for (const setting of [{ seed: 2 }, { steps: 200 }, { bodies: 61 }, { node: 'v1' }]) assert.ok(fingerprints(whole, setting).every((now, k) => now !== before[k]), JSON.stringify(setting));
  const ofCairn = (change) => fingerprintOf(whole.places, { ...kContestants.cairn, ...change }, whole.model, settings);
  assert.notEqual(ofCairn({ budget: { operations: 1 } }), before[0]);
  assert.equal(ofCairn({ what: 'another name' }), before[0]);
});

test('a kept run is taken where it is of the same fingerprint, else it is run anew', () => {
  const file = join(folder, 'run.json');
  let count = 0;
  const ask = (fingerprint, isResumed = true) => keptOr(file, fingerprint, isResumed, () => ({ count: ++count })).count;
  assert.deepEqual([ask('a'), ask('a'), ask('b'), ask('b'), ask('a')], [1, 1, 2, 2, 3]);
  assert.equal(ask('a', false), 4, 'without --resume');
  for (const text of ['{"count": 9}', '{"fingerprint": "a"}', '{"fingerp', 'null']) {
    writeFileSync(file, text);
    assert.equal(ask('a'), count, text);
  }
  assert.equal(count, 8, 'entries of older programs and halves of files are run anew');
});

test('a contestant is stopped at the third long step when they are ten times as long together', () => {
  const stepOf = (times) => 1 + times.findIndex(((isPatient) => (time) => !isPatient(time))(makePatience(100)));
  assert.equal(stepOf([99, 100, 99, 100, 99, 100, 99, 100, 99, 100, 99, 100]), 0, 'none is longer');
  assert.equal(stepOf([5000, 5000, 1, 1, 101]), 5);
  assert.equal(stepOf([101, 1, 101, 101, 101, 101, 101, 101, 101, 101, 101, 101]), 11);
  assert.equal(stepOf([5000, 5000, 1, 1, 1]), 0, 'two hiccups');
});

const spread = { mean: 0, max: 0 };
const judgedFrame = (nowhere = 0) => ({ depth: spread, pitDepth: spread, gap: spread, nowhere });
const measured = { engine: 'X', version: '1', lost: 0, apart: 0, asleep: 0, cpuMs: [1, 2], wallMs: [1, 2], narrowPhaseMs: [1, 1], missedMs: [], frames: [{ step: 1 }, { step: 2 }] };

test('bodies that are nowhere are lost', () => {
  const halfWidth = halfWidthOf(3);
  const good = [0, 1, 0, 0, 0, 0, 1];
  for (let k = 0; k < 7; ++k)
    for (const value of [NaN, Infinity, -Infinity]) assert.equal(countLost([...good, ...good.with(k, value)], halfWidth), 1, `${value} at ${k}`);
  assert.equal(figuresOf(measured, [judgedFrame(2), judgedFrame(1)]).lost, 2);
  assert.equal(figuresOf({ ...measured, lost: 3 }, [judgedFrame(2), judgedFrame(1)]).lost, 3);
  assert.equal(kScenes.chains.apart([...good, ...good.with(3, NaN)]), 1, 'a link that is nowhere holds nothing');
});

test('the judge counts who is nowhere, and measures the others', { skip: !kJudge && 'CAIRN_JUDGE names no judge' }, () => {
  const { vertices, indices } = makeBody('hook');
  const poses = kScenes.hooks.start(8, randomOf(1)).flatMap(({ position, rotation }) => [...position, ...rotation]);
  const file = join(folder, 'frames.json');
  const judge = (...frames) => {
    writeFileSync(file, JSON.stringify({ vertices: [...vertices], indices: [...indices], faces: pitFaces(1), frames }));
    return JSON.parse(execFileSync(kJudge, [file], { encoding: 'utf8' }));
  };
  const without = poses.slice(14);
  const [all, seven, some, none] = judge(poses, without, [...poses.slice(0, 7).fill(NaN, 4, 5), 0, 1, 0, 0, 0, 0, 0, ...without], [NaN, 0, 0, 0, 0, 0, 1]);
  assert.deepEqual([all, seven, some, none].map(({ nowhere }) => nowhere), [0, 0, 2, 1]);
  assert.deepEqual({ ...some, nowhere: 0 }, seven);
});

test('gaps are measured from the frame on that is asked for', { skip: !kJudge && 'CAIRN_JUDGE names no judge' }, () => {
  const { vertices, indices } = makeBody('hook');
  const poses = kScenes.hooks.start(8, randomOf(1)).flatMap(({ position, rotation }) => [...position, ...rotation]);
  const file = join(folder, 'gaps.json');
  writeFileSync(file, JSON.stringify({ vertices: [...vertices], indices: [...indices], faces: pitFaces(1), frames: [poses, poses], gapsFrom: 1 }));
  const [early, late] = JSON.parse(execFileSync(kJudge, [file], { encoding: 'utf8' }));
  assert.equal(early.gap, undefined);
  assert.ok(late.gap.pairs > 0);
  assert.deepEqual({ ...early, gap: late.gap }, late);
});

test('who was stopped stands in the table, the figure and the quotation', () => {
  const good = summaryOf([figuresOf(measured, [judgedFrame(), judgedFrame()])]);
  const table = tableOf('heap', 300, [1], { cairn: good, 'havok-mesh': { over: 100, with: 60 }, 'jolt-64': { over: 100 }, 'rapier-mesh': { failed: 'fell over' } });
  const rows = Object.fromEntries(table.split('\n').filter((line) => line.startsWith('| ')).map((line) => line.split('|').map((cell) => cell.trim())).map(([, name, first]) => [name, first]));
  assert.deepEqual([rows['Havok, mesh'], rows['Jolt, V-HACD 64'], rows['Rapier, mesh'], rows['Cairn, no budget']], ['over 100 ms already with 60 bodies', 'over 100 ms', 'fell over', '2.00']);
  const all = Object.fromEntries(Object.keys(kScenes).map((scene) => [scene, { cairn: good, 'jolt-64': scene === 'bowls' ? { over: 100 } : good }]));
  const quoted = quoteOf(['cairn', 'jolt-64'], all).split('\n');
  assert.equal(quoted.length, 4);
  assert.match(quoted[3], /^\| Jolt, V-HACD 64 \| 2\.0 \/ 2\.0 \/ 2\.0 \/ over 100 (\| 0\.00 \/ 0\.00 \/ 0\.00 \/ - ){2}\| 0 \|$/);
  drawFigure(join(folder, 'figure.svg'), { bowls: all.bowls });
});

test('the usual contestants have every engine, and one of each is quoted', () => {
  const engines = (list) => list.map((name) => kContestants[name].engine);
  assert.deepEqual([...new Set(engines(kUsual))], engines(kQuoted));
  assert.ok(!kUsual.includes('rapier-plain') && kQuoted.every((name) => kUsual.includes(name)));
});

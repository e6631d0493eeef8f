// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run's figures depend on, as one number: whoever resumes takes a kept run only where nothing of this has changed.
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

const kJudged = ['linking.mjs', 'measured.mjs', 'one_run.mjs', 'run.mjs', 'scenes.mjs']; // of demos/showdown
const kShared = ['bodies.mjs', 'common.mjs', 'hulls.mjs', 'mass.mjs', 'vectors.mjs']; // of demos/engines

const hashOf = (bytes) => createHash('sha256').update(bytes).digest('hex');
const ofFile = (file) => hashOf(readFileSync(file));
const ofFolder = (folder) => readdirSync(folder).sort().map((name) => [name, ofFile(join(folder, name))]);

/// `places`: folders `showdown` and `engines`, the folder `cairn` of the package cairn-collision, the program `judge`.
/// `model`: files of the mesh, its tree and its hulls. `settings`: whatever else decides, as JSON takes it.
export function fingerprintOf({ showdown, engines, cairn, judge }, contestant, model, settings) {
  const own = contestant.engine === 'cairn' ? [ofFolder(cairn), ofFile(model.tree)] : [ofFile(join(engines, 'package-lock.json')), ofFile(model.hulls)];
  const adapters = [...kShared, `${contestant.engine}.mjs`].map((name) => ofFile(join(engines, name)));
  const { engine, shape, simd, hulls, budget } = contestant; // its name decides nothing
  const parts = [kJudged.map((name) => ofFile(join(showdown, name))), { engine, shape, simd, hulls, budget }, adapters, own, ofFile(judge), ofFile(model.mesh), settings];
  return hashOf(JSON.stringify(parts));
}

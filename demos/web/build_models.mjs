// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes what the page's bodies consist of: mesh, certified sphere-tree, and convex parts for engines that need them.
//   node build_models.mjs CAIRN FOLDER [MESH]
// CAIRN is the program. MESH (OBJ) becomes one more body. What FOLDER holds of the same mesh already is kept. Where FOLDER has
// trajectories of rockfall merge as rocks.vtk, the page offers them.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { kBodies, makeBody, objOf, standard } from '../engines/bodies.mjs';
import { decompose } from '../engines/hulls.mjs';

const [program, folder, extra] = process.argv.slice(2);
const kLabels = { ring: 'Rings', bowl: 'Bowls', hook: 'Hooks', link: 'Chain links', knot: 'Knots', bunny: 'Bunnies', rock: 'Rocks' };
const kDecimals = 1e5; // a hundredth of a millimetre: convex parts are off by far more

function readObj(file) {
  const vertices = [];
  const indices = [];
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    const [kind, ...parts] = line.trim().split(/\s+/);
    if (kind === 'v') vertices.push(...parts.slice(0, 3).map(Number));
    if (kind === 'f') indices.push(...parts.slice(0, 3).map((part) => parseInt(part, 10) - 1));
  }
  return { vertices: Float32Array.from(vertices), indices: Uint32Array.from(indices) };
}

/// Counts, then vertices, then indices; little-endian as every browser is.
function meshBytes({ vertices, indices }) {
  const counts = Uint32Array.of(vertices.length, indices.length);
  return Buffer.concat([counts, vertices, indices].map((list) => Buffer.from(list.buffer, list.byteOffset, list.byteLength)));
}

/// The greatest certified error of the tree's last level, in metres.
function leafErrorOf(tree) {
  const { levels } = JSON.parse(execFileSync(program, ['inspect', tree, '--json', '-'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] }));
  return levels.at(-1).error_max;
}

async function make(model) {
  const { name } = model;
  const at = (ending) => join(folder, `${name}.${ending}`);
  const obj = objOf(model);
  const hash = createHash('sha256').update(obj).digest('hex');
  const known = existsSync(at('json')) ? JSON.parse(readFileSync(at('json'), 'utf8')) : {};
  if (known.hash !== hash) {
    process.stdout.write(`${name}: sphere-tree`);
    writeFileSync(at('obj'), obj);
    execFileSync(program, ['build', at('obj'), '-o', at('cairn'), '--no-evaluate'], { stdio: ['ignore', 'ignore', 'inherit'] });
    process.stdout.write(', convex parts\n');
    const hulls = (await decompose(model)).map((hull) => [...hull].map((value) => Math.round(value * kDecimals) / kDecimals));
    writeFileSync(at('hulls.json'), JSON.stringify(hulls));
    writeFileSync(at('mesh'), meshBytes(model));
    writeFileSync(at('part'), JSON.stringify({ hash }));
    renameSync(at('part'), at('json')); // last, so that what was cut short is made again
    rmSync(at('obj'));
  }
  return { name, label: kLabels[name] ?? name, leafError: leafErrorOf(at('cairn')) };
}

mkdirSync(folder, { recursive: true });
const models = kBodies.map(makeBody);
if (extra) models.push(standard(basename(extra, '.obj'), readObj(extra), 1));
const entries = [];
for (const model of models) entries.push(await make(model));
writeFileSync(join(folder, 'models.json'), JSON.stringify({ bodies: entries, hasRocks: existsSync(join(folder, 'rocks.vtk')) }));

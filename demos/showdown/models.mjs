// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies with their trees and convex parts, made once into a folder.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeBody, objOf, standard } from '../engines/bodies.mjs';
import { decompose } from '../engines/hulls.mjs';
import { kParts } from './contestants.mjs';

const engines = join(import.meta.dirname, '../engines');

/// Vertices and triangles of a Wavefront OBJ without texture coordinates, as `cairn simplify` writes it.
function readObj(text) {
  const rows = text.split('\n').map((line) => line.trim().split(/\s+/));
  const of = (kind) => rows.filter(([first]) => first === kind).flatMap(([, ...words]) => words);
  return { vertices: Float32Array.from(of('v').map(Number)), indices: Uint32Array.from(of('f').map((word) => parseInt(word, 10) - 1)) };
}

const bodyOf = (name, bunny) => (name === 'bunny' ? standard('bunny', readObj(readFileSync(bunny, 'utf8')), 1) : makeBody(name));

const hashOf = (...parts) => parts.reduce((hash, part) => hash.update(part).update('\0'), createHash('sha256')).digest('hex');

/// Makes a file where it is not there or was made of something else, which a hash tells.
async function madeOf(file, hash, make) {
  const stamp = `${file}.made-of`;
  if (existsSync(file) && existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) return;
  rmSync(stamp, { force: true });
  await make();
  writeFileSync(stamp, hash);
}

/// Names of the files of a body: its mesh and convex parts as JSON, its tree. `options` has `cairn`, `bunny` and `folder`.
export async function prepareModel(name, { cairn, bunny, folder }) {
  mkdirSync(folder, { recursive: true });
  const [mesh, obj, tree, hulls] = ['json', 'obj', 'cairn', 'hulls.json'].map((end) => join(folder, `${name}.${end}`));
  const body = bodyOf(name, bunny);
  const text = objOf(body);
  writeFileSync(obj, text);
  writeFileSync(mesh, JSON.stringify({ name, vertices: [...body.vertices], indices: [...body.indices] }));
  await madeOf(tree, hashOf(text, readFileSync(cairn)), () => execFileSync(cairn, ['build', obj, '-o', tree], { stdio: ['ignore', 'ignore', 'inherit'] }));
  const maker = ['hulls.mjs', 'package-lock.json'].map((file) => readFileSync(join(engines, file)));
  await madeOf(hulls, hashOf(text, ...maker, JSON.stringify(kParts)), async () => {
    const parts = {};
    for (const maxHulls of kParts) parts[maxHulls] = (await decompose(body, { maxHulls })).map((hull) => [...hull]);
    writeFileSync(hulls, JSON.stringify(parts));
  });
  return { mesh, tree, hulls };
}

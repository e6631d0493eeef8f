// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models that were made when the page was built: meshes at once, trees and convex parts when an engine asks for them.

async function fetched(path, kind) {
  const response = await fetch(new URL(path, document.baseURI)).catch(() => {
    throw new Error(`${path} could not be loaded; look whether the network is there, and try again.`);
  });
  if (!response.ok) throw new Error(`${path} could not be loaded (${response.status}); build the page again.`);
  return response[kind]();
}

function meshOf(buffer, name) {
  const [vertices, indices] = new Uint32Array(buffer, 0, 2);
  if (buffer.byteLength !== 8 + 4 * (vertices + indices)) throw new Error(`${name}: the mesh is cut short; build the page again.`);
  return { vertices: new Float32Array(buffer, 8, vertices), indices: new Uint32Array(buffer, 8 + 4 * vertices, indices) };
}

/// All models, each with its mesh, and whether there is an example of rocks to replay.
export async function loadModels() {
  const { bodies: list, hasRocks } = await fetched('models/models.json', 'json');
  const bodies = await Promise.all(list.map(async (entry) => ({ ...entry, mass: 1, ...meshOf(await fetched(`models/${entry.name}.mesh`, 'arrayBuffer'), entry.name) })));
  return { bodies, hasRocks };
}

/// Adds what an engine needs to a model; what was loaded stays.
export async function complete(model, { id, needsHulls }) {
  if (id === 'cairn') model.tree ??= new Uint8Array(await fetched(`models/${model.name}.cairn`, 'arrayBuffer'));
  if (needsHulls) model.hulls ??= (await fetched(`models/${model.name}.hulls.json`, 'json')).map((hull) => Float32Array.from(hull));
  const { name, vertices, indices, tree, hulls, mass } = model;
  return { name, vertices, indices, tree, hulls, mass };
}

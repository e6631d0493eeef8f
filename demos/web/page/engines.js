// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engines one can choose, and what their bodies are made of.
export const kEngines = [
  { id: 'cairn', label: 'Cairn', about: 'certified sphere-trees in Bullet' },
  { id: 'rapier', label: 'Rapier, meshes', about: 'moving triangle meshes' },
  { id: 'rapier-parts', label: 'Rapier, convex parts', about: 'its own convex decomposition' },
  { id: 'jolt', label: 'Jolt, convex parts', about: 'convex parts by V-HACD', needsHulls: true },
  { id: 'havok', label: 'Havok, meshes', about: 'moving triangle meshes' },
];

export const engineOf = (id) => kEngines.find((engine) => engine.id === id);

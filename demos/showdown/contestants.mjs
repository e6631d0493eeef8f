// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who takes part, and with what. What an engine's adapter sets, and why, is said in demos/engines.

export const kContestants = {
  'cairn': { engine: 'cairn', shape: 'tree', what: 'Cairn, no budget' },
  'cairn-50k': { engine: 'cairn', shape: 'tree', budget: { operations: 50000 }, isExtra: true, what: 'Cairn, 50,000 operations' },
  'cairn-20k': { engine: 'cairn', shape: 'tree', budget: { operations: 20000 }, what: 'Cairn, 20,000 operations' },
  'cairn-2ms': { engine: 'cairn', shape: 'tree', budget: { microseconds: 2000 }, what: 'Cairn, 2 ms' },
  'cairn-leaves': { engine: 'cairn', shape: 'leaves', what: 'Cairn, contacts at leaves' },
  'rapier-mesh': { engine: 'rapier', shape: 'mesh', what: 'Rapier, mesh' },
  'rapier-decomposition': { engine: 'rapier', shape: 'decomposition', what: 'Rapier, its decomposition' },
  'rapier-plain': { engine: 'rapier', shape: 'decomposition', simd: false, isExtra: true, what: 'Rapier, its decomposition, newest version without vectors' },
  'rapier-hulls': { engine: 'rapier', shape: 'hulls', what: 'Rapier, V-HACD 16' },
  'jolt-16': { engine: 'jolt', shape: 'hulls', hulls: 16, what: 'Jolt, V-HACD 16' },
  'jolt-64': { engine: 'jolt', shape: 'hulls', hulls: 64, what: 'Jolt, V-HACD 64' },
  'havok-mesh': { engine: 'havok', shape: 'mesh', what: 'Havok, mesh' },
  'havok-hulls': { engine: 'havok', shape: 'hulls', what: 'Havok, V-HACD 16' },
};

/// Who takes part when nobody is named.
export const kUsual = Object.keys(kContestants).filter((name) => !kContestants[name].isExtra);

/// One of each engine for the README: Cairn as it comes, of the others the most accurate that keeps up with 100 bodies.
export const kQuoted = ['cairn', 'rapier-decomposition', 'jolt-64', 'havok-hulls'];

export const kParts = [16, 64]; // of V-HACD, at most

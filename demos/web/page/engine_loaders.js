// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the worker gets an engine from. Each comes over the net only when it is chosen.
const rapier = (shape) => async () => (await import('../../engines/rapier.mjs')).load({ shape });

export const kLoaders = {
  cairn: async () => (await import('../../engines/cairn.mjs')).load({ shape: 'tree' }),
  rapier: rapier('mesh'),
  'rapier-parts': rapier('decomposition'),
  jolt: async () => (await import('../../engines/jolt.mjs')).load({ shape: 'hulls' }),
  havok: async () => (await import('../../engines/havok.mjs')).load({ shape: 'mesh' }),
};

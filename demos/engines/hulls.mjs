// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convex parts for engines that cannot collide two moving meshes: V-HACD 4 as the package vhacd-js has it.

/// At most so many parts of a body: what V-HACD's own default of 64 gains costs these engines more than it is worth
/// (docs of Jolt: few, simple hulls). Voxels are V-HACD's default.
const kOptions = { maxHulls: 16, maxVerticesPerHull: 32, voxelResolution: 400000 };

/// Points of each convex part of a closed mesh. The same mesh gives the same parts. Takes seconds.
export async function decompose({ vertices, indices }, options = {}) {
  const { ConvexMeshDecomposition } = await import('vhacd-js/lib/vhacd.js');
  const decomposer = await ConvexMeshDecomposition.create();
  const mesh = { positions: Float64Array.from(vertices), indices: Uint32Array.from(indices) };
  return decomposer.computeConvexHulls(mesh, { ...kOptions, ...options }).map(({ positions }) => Float32Array.from(positions));
}

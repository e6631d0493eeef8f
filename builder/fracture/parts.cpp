// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/parts.h"

#include <cstddef>
#include <cstdint>

#include "fracture/renumbered.h"
#include "surface/edges.h"
#include "surface/mass_properties.h"
#include "surface/signed_distance.h"

namespace cairn::builder {
namespace {

std::vector<TriangleMesh> shellMeshes(const TriangleMesh& mesh) {
  const Shells shells = shellsOf(mesh, sortedHalfEdges(mesh));
  std::vector<TriangleMesh> meshes(shells.count);
  for (TriangleMesh& shell : meshes) shell.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    meshes[shells.ofTriangle[t]].triangles.push_back(mesh.triangles[t]);
  return meshes;
}

// The smallest of the solids around a point. Precondition: there is one.
std::size_t smallestAround(const std::vector<TriangleMesh>& solids, const Vec3d& point) {
  std::size_t smallest = solids.size();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const TriangleMesh solid = renumbered(solids[i]);
    if (SignedDistance(solid).query(point).depth <= 0) continue;
    if (smallest == solids.size() || signedVolume(solids[i]) < signedVolume(solids[smallest])) smallest = i;
  }
  return smallest;
}

}  // namespace

std::vector<TriangleMesh> partsOf(const TriangleMesh& mesh) {
  std::vector<TriangleMesh> parts, cavities;
  for (TriangleMesh& shell : shellMeshes(mesh))
    (signedVolume(shell) > 0 ? parts : cavities).push_back(std::move(shell));
  std::vector<std::vector<Triangle>> walls(parts.size());
  for (const TriangleMesh& cavity : cavities) {
    const std::size_t around = smallestAround(parts, cavity.corners(0)[0]);
    if (around < parts.size())
      walls[around].insert(walls[around].end(), cavity.triangles.begin(), cavity.triangles.end());
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].triangles.insert(parts[i].triangles.end(), walls[i].begin(), walls[i].end());
    parts[i] = renumbered(parts[i]);
  }
  return parts;
}

}  // namespace cairn::builder

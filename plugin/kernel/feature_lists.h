// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/near_patches.h"
#include "kernel/patch_tests.h"

namespace cairn::bullet {

/// Pairs of features of two surfaces that may touch: A's first. Indices are the meshes' own.
struct FeatureLists {
  using List = std::vector<std::array<std::uint32_t, 2>>;

  List verticesOnFaces, facesOnVertices, edgesOnEdges, edgesThroughFaces, facesThroughEdges;

  void clear();
  std::size_t size() const;
  /// World length: the surfaces are no nearer; minus infinity where anything is listed.
  float apart = 0;
};

/// Makes such lists: boxes leave few patches, vectors few of their features.
class FeatureLister {
 public:
  /// Each pair is listed once, ascending. False when the budget does not cover what is compared.
  bool list(const SurfacePair& surfaces, const ContactLimits& limits, FeatureLists& lists, Budget& budget);

 private:
  void append(FeatureLists& lists) const;

  NearPatches nearPatches_;
  PatchPair patches_;
};

}  // namespace cairn::bullet

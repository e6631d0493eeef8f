// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "counterparts/counterpart.h"
#include "triangles/ground_surface.h"
#include "triangles/triangle.h"

namespace cairn::bullet {

/// The contacts of a tree with one of Bullet's meshes, surface against surface, where that is closed: a body is on the
/// side where most of it was when it came near.
class MeshGround {
 public:
  /// What of the mesh is near the tree.
  struct Near {
    const btConcaveShape& shape;
    const TriangleSoup& soup;
    std::span<const Triangle> inPair;  ///< the soup's, in the pair frame
  };

  void reset();
  /// Notes on which side of it the body is. To be told in each step. False near what is open, where pieces of the mesh
  /// show the body different sides, and where triangles change.
  bool watch(const RelativePlacement& now, const PairPlacement& placement, const Near& near);
  /// See `Counterpart::appendOfMesh`. Precondition: `watch` said so in this step.
  std::optional<float> append(const MeshQuestion& question, const PairPlacement& placement, const Near& near,
                              std::vector<Contact>& contacts);
  /// Where in the soup a triangle is that a contact of the last answer was told with.
  static std::uint32_t inSoup(const TriangleSoup& soup, const Contact& contact);

 private:
  struct Piece {
    std::uint32_t index = 0;
    bool isBehind = false;  // the body, of where its faces show to
  };

  bool follow(const Near& near);
  void takeSides(const PairPlacement& placement, const Near& near);
  bool isBehind(const PairPlacement& placement, const Near& near, std::uint32_t piece);
  ContactId idOf(const Near& near, const FeatureContact& contact) const;

  std::shared_ptr<const GroundSurface> surface_;
  bool hasGivenUp_ = false;  // its triangles change
  bool isReversed_ = false;
  std::vector<Piece> pieces_, lastPieces_;    // that are near, and were a step ago
  std::vector<std::uint32_t> nearTriangles_;  // of the surface, in the soup's order
  std::vector<Triangle> asked_;
  RelativePlacement watchedAt_;  // last
  KernelMemory memory_;
};

}  // namespace cairn::bullet

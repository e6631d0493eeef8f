// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "contacts/contact.h"
#include "contacts/directional_gap.h"
#include "placement/placed_tree.h"
#include "triangles/triangle.h"

namespace cairn::bullet {

/// Past the leaves (thesis 8.3.7): the contact of two leaves, measured between their source triangles.
///
/// The direction stays that of the leaves' contact, which is what holds bodies still; the gap along it becomes that of
/// the triangles, and the places those where it is smallest. A pair of leaves whose triangles do not cover each other
/// in that direction is asked along the middles of the regions' normals instead, unless they touch and
/// that tells them deeper in each other than the leaves do, and if they do not there either, how near its triangles
/// come to each other at all.
class ExactContacts {
 public:
  /// Points for one pair of leaves: the deepest, and others as deep, far from each other.
  static constexpr std::size_t kMaxPoints = 4;

  /// Replaces `rough` by what the triangles say, appending nothing when they are not below `reach` apart. False, and
  /// nothing appended, when the budget does not cover it: 2 operations per triangle that is moved, 1 per pair that is
  /// compared. Precondition: `rough` is of two leaves' regions, not of spheres. `margins`: of both surfaces together.
  bool replace(const PlacedTree& a, const PlacedTree& b, float margins, float reach, const Contact& rough,
               Budget& budget, std::vector<Contact>& contacts);

 private:
  bool look(const PlacedTree& a, const PlacedTree& b, const NodePair& pair, const Vec3& normal, float reach,
            Budget& budget);
  bool appendNearest(const PlacedTree& a, const PlacedTree& b, float margins, float reach, const Contact& rough,
                     Budget& budget, std::vector<Contact>& contacts);
  static bool isDeeper(std::span<const GapPoint> points, float gap);
  std::optional<Vec3> faceUnder(const Vec3& normal) const;
  void appendChosen(const Vec3& normal, float margins, const Contact& rough, std::vector<Contact>& contacts) const;
  void choose(std::span<const GapPoint> points, float reach);

  DirectionalGap gap_;
  std::vector<GapPoint> chosen_;
  std::vector<Triangle> ofA_, ofB_;
};

}  // namespace cairn::bullet

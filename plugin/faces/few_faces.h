// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "contacts/contact.h"
#include "contacts/directional_gap.h"
#include "contacts/normal_clusters.h"
#include "faces/separating_feature.h"

namespace cairn::bullet {

/// Contacts of two bodies of few triangles: the corners of what these have in common along the direction the bodies
/// touch in, instead of every pair of leaves.
///
/// Flush faces bring hundreds of leaf pairs into contact, and all say the same. Two convex bodies are measured along
/// the feature that separates them best. Other bodies are first measured between leaves; once these have told which
/// faces carry, the faces are enough for as long as it is certain that nothing else touches: every two triangles that
/// leaf pairs name either lie on each other along the direction of a carrying face or are apart along it. See
/// docs/algorithms/contacts.md.
class FewFaces {
 public:
  /// Forgets the bodies.
  void reset();
  /// A traversal of two trees begins: its leaf pairs will be others. Allocates what `append` may need.
  void start(const SphereTree& a, const SphereTree& b);

  /// Learns from contacts measured between leaves: remembers the features whose directions the pair's common normals
  /// are (unit, or zero), and nothing if any is none's.
  void learn(const PlacedTree& a, const PlacedTree& b, std::span<const Vec3> normals);
  /// Puts the remembered directions where the bodies stand now in place of those within 3 degrees.
  void carry(const PlacedTree& a, const PlacedTree& b, std::span<Vec3> normals) const;

  /// Appends the contacts below `reach`, and returns how far the bodies are apart at least; minus infinity where that
  /// is not known. Nothing, and nothing appended, when the triangles cannot tell. `leafPairs`: of the traversal, which
  /// is done. `margins`: of both surfaces together. Charges two operations for each triangle and one for each pair of
  /// them, whatever is left of the budget. Linear in these, and once a traversal linear in its leaf pairs; see
  /// `bestSeparation` for convex bodies whose direction changes.
  std::optional<float> append(const PlacedTree& a, const PlacedTree& b, float margins, float reach,
                              std::span<const NodePair> leafPairs, Budget& budget, std::vector<Contact>& contacts);

 private:
  // Two triangles that may touch, and the first leaf pair that said so.
  struct TrianglePair {
    std::uint8_t ofA, ofB;
    NodePair leaves;
  };
  struct Question;
  enum class Answer : std::uint8_t { apart, explained, unknown };

  void collect(const SphereTree& a, const SphereTree& b, std::span<const NodePair> leafPairs);
  void collect(std::span<const GapPoint> points, std::span<const NodePair> leafPairs);
  std::size_t placeOf(const GapPoint& point) const;
  bool look(Question& question) const;
  std::optional<float> appendConvex(Question& question, std::span<const NodePair> leafPairs,
                                    std::vector<Contact>& contacts);
  std::optional<float> appendConcave(Question& question, std::span<const NodePair> leafPairs,
                                     std::vector<Contact>& contacts);
  bool areKept(const Question& question) const;
  void showAlong(const Question& question, std::size_t k);
  void appendAlong(const Question& question, std::size_t k, std::span<const NodePair> leafPairs,
                   std::vector<Contact>& contacts);
  Answer ask(const Question& question, const TrianglePair& pair, std::vector<Contact>& contacts);
  bool appendCommon(const Question& question, std::size_t k, const TrianglePair& pair, std::vector<Contact>& contacts);
  void append(const Question& question, std::size_t k, const NodePair& leaves, const GapPoint& point,
              std::vector<Contact>& contacts) const;

  std::array<SeparatingFeature, kMaxClusters> features_{};
  std::size_t featureCount_ = 0;
  const SphereTree *treeA_ = nullptr, *treeB_ = nullptr;
  std::vector<Vec3> outwardsA_, outwardsB_;  // of their triangles, tree axes
  std::vector<TrianglePair> pairs_;
  std::vector<std::uint16_t> pairAt_;  // which of these, by the triangle of A and then that of B
  bool areServed_ = false, areConvex_ = false;
  bool areNew_ = true;        // the leaf pairs
  std::size_t compared_ = 0;  // pairs of triangles, in this step
  DirectionalGap gap_;
  std::vector<std::uint8_t> uppers_, lowers_;  // triangles, in the order in which the gap took them in

  static constexpr std::uint16_t kNone = 0xFFFF, kWanted = 0xFFFE;
};

}  // namespace cairn::bullet

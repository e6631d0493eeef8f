// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cairn/core/export.h"

class btCollisionObject;

namespace cairn::bullet {

/// The limit on the work of one simulation step, for all pairs together. An unset field is no limit; with both set, the
/// step ends at whichever is reached first.
///
/// Operations are those of Eq. 2.1 of the thesis: 2 per sphere moved, 1 per overlap test. They limit refinement, and
/// the result is reproducible. Microseconds are elapsed time since Bullet's pass over its pairs began, pairs without a
/// sphere-tree included. They are not reproducible. After steps that ran over, planning aims at an earlier end, by a
/// quarter of the limit at most.
struct StepBudget {
  std::optional<std::int64_t> operations;  ///< limit of refinement; unset: none
  std::optional<double> microseconds;      ///< limit of elapsed time; unset: none
};

/// Numbers of pairs with a sphere-tree that are still to come, besides those that exist, by the tree's collider.
struct ExpectedPairs {
  std::size_t trees = 0;           ///< pairs of two trees
  std::size_t planes = 0;          ///< pairs with a `btStaticPlaneShape`
  std::size_t convexShapes = 0;    ///< pairs with any convex shape
  std::size_t triangleMeshes = 0;  ///< pairs with a shape of triangles
  std::size_t distanceFields = 0;  ///< pairs with a `btSdfCollisionShape`
  std::size_t terrains = 0;        ///< pairs with a `TerrainShape`
};

/// The answer of an unresolved pair, whose traversal did not end within the budget (thesis 2.4; compared in
/// docs/algorithms/leaf-contacts.md).
enum class Unresolved : std::uint8_t {
  guard,       ///< default: last finished contacts, re-tested; without any, spheres that may not come nearer
  repel,       ///< unrefined spheres as they are: no contact is missed; bodies float by up to the error
  ignore,      ///< last finished contacts, re-tested, and nothing else: bodies may sink in
  compensate,  ///< unrefined spheres, with their certified error subtracted from the depth
};

/// Where refinement ends.
enum class Finest : std::uint8_t {
  leaves,  ///< contacts between the regions of leaves: faster, wrong by up to the tree's error
  /// Default: once the leaves are found, the rest of the budget goes to the source meshes (thesis 8.3.7). Contacts of
  /// two sphere-trees are then the local minima of the distance between their meshes.
  triangles,
};

/// Statistics of the narrow phase in one step.
struct StepStatistics {
  std::uint64_t operations = 0;  ///< all work charged, re-tests included
  /// CPU time of the calling thread in the whole dispatch, pairs without a sphere-tree included. Installed on a
  /// dispatcher: elapsed time of the narrow phase alone.
  double microseconds = 0;
  /// Elapsed time of the same work, which a budget in microseconds limits. The operating system gave the difference
  /// from `microseconds` to other threads.
  double elapsedMicroseconds = 0;
  /// The time the step was allowed, by its own budget and its share of the frame's. Unset without a limit in time.
  std::optional<double> deadlineMicroseconds;
  double missedByMicroseconds = 0;  ///< by how much the step exceeded its deadline; 0 if it did not, or has none
  /// Pairs with a sphere-tree that the broad phase reported. Trees nested in three or more compounds are answered at
  /// once, in full, and not counted.
  std::uint32_t pairs = 0;
  /// Pairs with a non-finite body: its place, speed or force is NaN or infinite. They get no contacts, so that they
  /// harm no other pair. Pairs of queries since the last step count too. The first such pair is reported in the
  /// log.
  std::uint32_t nonFinitePairs = 0;
  std::uint32_t unresolvedPairs = 0;  ///< those of `pairs` that got no budget, or stopped half-way
  std::uint32_t contacts = 0;         ///< points these pairs handed to the solver
  std::uint32_t exactContacts = 0;    ///< those of `contacts` measured between source triangles
  std::uint32_t manifolds = 0;        ///< non-empty manifolds of these pairs
  /// Largest certified error among the pairs' answers, as a fraction of the smaller body's size (diagonal of its mesh's
  /// bounding box). Surfaces that are reported or unresolved are at most this and the speculative distance
  /// (`kSpeculativeFraction`) apart. An unresolved pair counts even when it reports no contact.
  double worstErrorFraction = 0;
  double meanErrorFraction = 0;  ///< mean error over the pairs that report contacts
  /// The largest error as an angle at the viewer, in radians (`cairn::seenError`); 0 without a viewer.
  double worstSeenError = 0;
  double meanSeenError = 0;  ///< mean of these angles over the pairs that report contacts
};

/// The last answer of a pair with a sphere-tree.
struct PairAnswered {
  const btCollisionObject* first = nullptr;   ///< of both bodies; of a compound's child, the compound
  const btCollisionObject* second = nullptr;  ///< the other one
  bool isUnresolved = false;                  ///< its traversal got no budget, or stopped half-way
  std::uint32_t contacts = 0;                 ///< points handed to the solver
  double errorFraction = 0;  ///< certified error, as in `StepStatistics::worstErrorFraction`; also without contacts
};

}  // namespace cairn::bullet

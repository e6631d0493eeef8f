// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cairn::bullet {

/// What one simulation step may cost, over all pairs together. Unset means unlimited; both set: whichever ends first.
/// Operations are those of Eq. 2.1 of the thesis (2 per sphere moved, 1 per overlap test), limit refinement and are
/// reproducible. Microseconds run from the beginning of Bullet's pass over its pairs, those without a sphere-tree
/// included; they are elapsed time, and not reproducible. Steps are planned to end earlier than that by what those
/// before ran over, a quarter of it at most.
struct StepBudget {
  std::optional<std::int64_t> operations;
  std::optional<double> microseconds;
};

/// How many pairs with a sphere-tree are still to come, beside those there are, by what the tree meets.
struct ExpectedPairs {
  std::size_t trees = 0, planes = 0, convexShapes = 0, triangleMeshes = 0, distanceFields = 0, terrains = 0;
};

/// What a pair answers while its traversal is unfinished (thesis 2.4; compared in docs/algorithms/leaf-contacts.md).
enum class Unresolved : std::uint8_t {
  guard,       ///< last finished contacts, re-tested; while they say nothing, spheres that may not approach further
               ///< (default)
  repel,       ///< the unrefined spheres as they are: never missed, floats by the error
  ignore,      ///< last finished contacts, re-tested, and nothing else: may sink in
  compensate,  ///< the unrefined spheres, their certified error subtracted from the depth
};

/// Where refinement ends.
enum class Finest : std::uint8_t {
  leaves,     ///< contacts between the regions of leaves: quicker, off by up to the tree's error
  triangles,  ///< what is left of the budget once the leaves are found goes on to the source meshes (thesis 8.3.7):
              ///< contacts of two sphere-trees are the local minima of the distance between their meshes (default)
};

/// What the narrow phase did in the last step.
struct StepStatistics {
  std::uint64_t operations = 0;  ///< all work charged, re-testing included
  double microseconds = 0;       ///< CPU time of the calling thread in the whole dispatch, pairs without a sphere-tree
                                 ///< included (installed on a dispatcher: elapsed time of the narrow phase alone)
  /// Elapsed time of the same: what a budget in microseconds limits. What is more than `microseconds` the operating
  /// system gave to others.
  double elapsedMicroseconds = 0;
  /// What the step might take, of its own budget and its share of the frame's; unset without a limit in time.
  std::optional<double> deadlineMicroseconds;
  double missedByMicroseconds = 0;  ///< by how much it took longer; 0 where it did not, or has no deadline
  /// Pairs with a sphere-tree that the broad phase reported. Trees nested in three or more compounds are answered at
  /// once, in full, and not counted.
  std::uint32_t pairs = 0;
  /// Pairs of which a body's place, speed or force is no number or endless, those included that queries asked about
  /// since the last step: they have no contacts, so that it harms no other. The first one is told on standard error.
  std::uint32_t nonFinitePairs = 0;
  std::uint32_t unresolvedPairs = 0;  ///< of `pairs`, those the budget left nothing for, or stopped half-way
  std::uint32_t contacts = 0;         ///< points handed to the solver by these pairs
  std::uint32_t exactContacts = 0;    ///< of these, measured between source triangles
  std::uint32_t manifolds = 0;        ///< non-empty manifolds of these pairs
  /// Worst certified error among the pairs' answers, as a fraction of the smaller body's size (bounding-box diagonal of
  /// its mesh): surfaces reported or still to be resolved are at most this and the speculative distance
  /// (`kSpeculativeFraction`) apart. What is unresolved counts even when the pair reports nothing.
  double worstErrorFraction = 0;
  double meanErrorFraction = 0;  ///< mean of the same over pairs that report anything
  /// The same errors as angles in radians at which the viewer sees them, see `cairn::seenError`; 0 without a viewer.
  double worstSeenError = 0, meanSeenError = 0;
};

}  // namespace cairn::bullet

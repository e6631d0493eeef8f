// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::builder {

/// One bit for each pair of candidate and point: whether the candidate holds the point. The selection of spheres counts
/// and compares such sets. The words of all candidates lie side by side, so one candidate is compared with several
/// others at a time. It uses the fastest instruction set present; results do not depend on it.
class HeldSets {
 public:
  static constexpr std::size_t kBitsPerWord = 64;
  /// Row length of a table of costs for a number of points.
  static constexpr std::size_t paddedPoints(std::size_t points) {
    return (points + kBitsPerWord - 1) / kBitsPerWord * kBitsPerWord;
  }

  /// Candidate i holds point p where `costs[i * padded + p]` is at most `standOff`. Precondition: `costs` has whole
  /// rows of `padded` = `paddedPoints(points)` entries, infinite beyond the points.
  HeldSets(std::span<const double> costs, std::size_t padded, double standOff);

  /// Number of candidates left; they keep their order.
  std::size_t size() const { return names_.size(); }
  /// Index of candidate i at construction.
  std::size_t name(std::size_t i) const { return names_[i]; }
  /// Number of points that candidate i holds.
  std::size_t count(std::size_t i) const { return counts_[i]; }
  /// Number of points that any candidate holds.
  std::size_t unionCount() const;
  /// Number of candidates whose points candidate i also holds, itself included. Linear in candidates times words.
  std::size_t subsetsOf(std::size_t i) const;

  /// Removes candidates by their names (`barred`), and those that hold no point.
  void drop(std::span<const std::size_t> barred);
  /// Removes the points of candidate i from all candidates, then those candidates that hold no point any more.
  void take(std::size_t i);

 private:
  void countAll();

  std::size_t words_, stride_;         // columns, padded to whole vectors
  std::vector<std::uint64_t> bits_;    // [word][candidate]
  std::vector<std::size_t> names_;     // by candidate left
  std::vector<std::uint64_t> counts_;  // by column
};

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::builder {

/// Which candidates hold which points, as one bit each. Selecting spheres is counting and comparing such sets, so the
/// words of all candidates lie side by side and one candidate is compared with several others at a time, with the
/// fastest instruction set present and the same result on every one.
class HeldSets {
 public:
  static constexpr std::size_t kBitsPerWord = 64;
  /// Row length of a table of costs for so many points.
  static constexpr std::size_t paddedPoints(std::size_t points) {
    return (points + kBitsPerWord - 1) / kBitsPerWord * kBitsPerWord;
  }

  /// Candidate i holds point p where `costs[i * padded + p]` is at most `standOff`. Precondition: `costs` are whole
  /// rows of `padded` = `paddedPoints(points)`, infinite beyond the points.
  HeldSets(std::span<const double> costs, std::size_t padded, double standOff);

  /// Candidates left; they keep their order.
  std::size_t size() const { return names_.size(); }
  /// Index of candidate i at construction.
  std::size_t name(std::size_t i) const { return names_[i]; }
  /// Points it holds.
  std::size_t count(std::size_t i) const { return counts_[i]; }
  /// Points that any candidate holds.
  std::size_t unionCount() const;
  /// Candidates whose points candidate i holds as well, itself included. Linear in candidates times words.
  std::size_t subsetsOf(std::size_t i) const;

  /// Leaves out candidates by their names (`barred`), and those that hold nothing.
  void drop(std::span<const std::size_t> barred);
  /// Takes the points of candidate i away from all, and leaves out those that hold nothing any more.
  void take(std::size_t i);

 private:
  void countAll();

  std::size_t words_, stride_;         // columns, padded to whole vectors
  std::vector<std::uint64_t> bits_;    // [word][candidate]
  std::vector<std::size_t> names_;     // by candidate left
  std::vector<std::uint64_t> counts_;  // by column
};

}  // namespace cairn::builder

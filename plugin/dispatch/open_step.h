// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

class btCollisionDispatcher;

namespace cairn::bullet {

class StepPairs;
struct TreePair;

/// The steps of a dispatcher that says neither where they begin nor where they end: tells from the pairs that come, and
/// remembers which to expect next time.
class OpenStep {
 public:
  /// Whether a new step has begun when this pair comes: it has been answered in the step at hand, or nobody expected it
  /// where it is (`isPrepared` false) and bodies have moved since.
  bool isOver(const TreePair& pair, bool isPrepared) const;
  /// The next pair begins a step, whatever it is.
  void end() { isEnded_ = true; }
  bool hasEnded() const { return isEnded_; }

  /// A new step; adds the pairs to expect in it to `expected`, taken to where their bodies are now. Those that are
  /// asleep wait for another step; those whose shapes have changed are no longer known.
  void begin(btCollisionDispatcher& dispatcher, StepPairs& expected);
  /// The pair was answered, expected (or apart, which costs nothing) or not; it is known from now on.
  void answered(TreePair& pair, bool wasExpected);
  /// No longer known: destroyed, or expected and not come.
  void forget(TreePair& pair);

  /// What fraction of a step's budget to keep for pairs that nobody expects, going by those of the step before: for
  /// each as much as for one that is known.
  double reserve(std::size_t expected) const;

 private:
  // Pairs of this step whose bodies are watched: one that moved tells of a new step.
  static constexpr std::size_t kMaxWitnesses = 8;
  // Kept when the step before had no newcomers.
  static constexpr double kQuietReserve = 1.0 / 64;

  std::uint64_t number_ = 0;
  bool isEnded_ = true;
  std::vector<TreePair*> known_;
  std::vector<TreePair*> witnesses_;
  std::size_t newcomers_ = 0, lastNewcomers_ = 0;
};

}  // namespace cairn::bullet

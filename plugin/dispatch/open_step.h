// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

class btCollisionDispatcher;

namespace cairn::bullet {

class StepPairs;
struct TreePair;

/// The steps of a dispatcher that announces neither their beginning nor their end. They are recognised by the pairs
/// that come, and the pairs of a step are expected again in the next one.
class OpenStep {
 public:
  /// Whether this pair begins a new step: it was answered in the present step already, or it comes unexpectedly
  /// (`isPrepared` false) and bodies have moved since.
  bool isOver(const TreePair& pair, bool isPrepared) const;
  /// The next pair begins a new step in any case.
  void end() { isEnded_ = true; }
  bool hasEnded() const { return isEnded_; }

  /// Begins a new step and adds the pairs to expect to `expected`, at their bodies' present poses. Sleeping pairs wait
  /// for another step. Pairs whose shapes have changed are forgotten.
  void begin(btCollisionDispatcher& dispatcher, StepPairs& expected);
  /// The pair was answered, and is known from now on. `wasExpected`: it was expected, or culled, which costs nothing.
  void answered(TreePair& pair, bool wasExpected);
  /// Forgets a pair that was destroyed, or that was expected and did not come.
  void forget(TreePair& pair);

  /// The fraction of a step's budget to reserve for unexpected pairs. It follows the step before: each unexpected pair
  /// counts as much as a known one.
  double reserve(std::size_t expected) const;

 private:
  // Some pairs of this step, whose bodies are watched: a body that moved shows that a new step has begun.
  static constexpr std::size_t kMaxWitnesses = 8;
  // Reserved when the step before had no unexpected pairs.
  static constexpr double kQuietReserve = 1.0 / 64;

  std::uint64_t number_ = 0;
  bool isEnded_ = true;
  std::vector<TreePair*> known_;
  std::vector<TreePair*> witnesses_;
  std::size_t newcomers_ = 0, lastNewcomers_ = 0;
};

}  // namespace cairn::bullet

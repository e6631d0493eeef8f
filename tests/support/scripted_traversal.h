// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/scheduler.h"

namespace cairn::test {

/// A traversal whose front is a list of errors, oldest first. One pair of it takes a whole turn of operations, and
/// every turn is noted down in a log shared by all.
class ScriptedTraversal final : public Traversal {
 public:
  ScriptedTraversal(int name, std::vector<float> errors, std::vector<int>& log)
      : name_(name), errors_(std::move(errors)), log_(&log) {
    restart();
  }

  void restart() {
    abandon();
    for (std::uint32_t i = 0; i < errors_.size(); ++i) queue_.push_back({i, 0});
  }
  Progress refine(Budget& budget) override {
    while (!done()) {
      if (!budget.charge(Scheduler::kTurnOperations)) return Progress::budgetSpent;
      ++head_;
      log_->push_back(name_);
    }
    return Progress::done;
  }
  bool mayTouch(const NodePair& /*pair*/) const override { return true; }
  float pairError(const NodePair& pair) const override { return errors_[pair.a]; }

 private:
  int name_;
  std::vector<float> errors_;
  std::vector<int>* log_;
};

}  // namespace cairn::test

// SPDX-License-Identifier: Zlib
#include "dispatch/step_rules.h"

#include <cassert>
#include <string>
#include <utility>

#include "cairn/core/round_robin.h"

namespace cairn::bullet {

namespace {

Status check(const StepBudget& budget, const std::string& what) {
  if (budget.operations && *budget.operations < 0)
    return Error{what + " cannot have " + std::to_string(*budget.operations) +
                 " operations: give 0 or more, or leave them unset for no limit"};
  if (budget.microseconds && !(*budget.microseconds >= 0))
    return Error{what + " cannot have " + std::to_string(*budget.microseconds) +
                 " microseconds: give 0 or more, or leave them unset for no limit"};
  return {};
}

}  // namespace

StepRules::StepRules(StepEnd end) : end_(end), priority_(std::make_unique<RoundRobin>()) {}

Status StepRules::setBudget(const StepBudget& budget) {
  const Status status = check(budget, "a step");
  if (status) budget_ = budget;
  return status;
}

Status StepRules::setFrameBudget(const StepBudget& budget) {
  const Status status = check(budget, "a frame");
  if (!status) return status;
  frame_ = FrameBudget(budget);
  hasFrameBudget_ = budget.operations || budget.microseconds;
  return {};
}

void StepRules::setPriority(std::unique_ptr<Priority> priority) {
  assert(priority);
  nextPriority_ = std::move(priority);
}

void StepRules::adoptPriority() {
  if (!nextPriority_) return;
  priority_ = std::move(nextPriority_);
  priority_->setViewer(viewer_);
}

Status StepRules::setViewer(const std::optional<Viewer>& viewer) {
  if (viewer)
    if (Status status = checkViewer(*viewer); !status) return status;
  viewer_ = viewer;
  priority_->setViewer(viewer_);
  return {};
}

Budget StepRules::budgetOf(const StepBudget& limit) {
  const std::uint64_t operations =
      limit.operations ? static_cast<std::uint64_t>(*limit.operations) : Budget::kUnlimited;
  return limit.microseconds ? Budget::both(operations, *limit.microseconds) : Budget::operations(operations);
}

bool StepRules::mayBeInterrupted() const {
  return budget_.operations || budget_.microseconds || hasFrameBudget_;
}

}  // namespace cairn::bullet

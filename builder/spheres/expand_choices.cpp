// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/expand_choices.h"

#include <cassert>

#include "spheres/expand_selection.h"

namespace cairn::builder {

struct ExpandChoices::Costs {
  ExpandCosts table;
};

ExpandChoices::ExpandChoices(std::span<const Vec3d> points, std::span<const Ball> candidates, ExpandRank rank)
    : costs_(std::make_unique<Costs>(Costs{ExpandCosts(PointSet(points), candidates, rank)})) {}
ExpandChoices::~ExpandChoices() = default;
ExpandChoices::ExpandChoices(ExpandChoices&&) noexcept = default;
ExpandChoices& ExpandChoices::operator=(ExpandChoices&&) noexcept = default;

double ExpandChoices::leastStandOff() const {
  return costs_->table.leastFeasible();
}

double ExpandChoices::enoughForOne() const {
  return costs_->table.enoughForOne();
}

std::size_t ExpandChoices::ballsAt(double standOff) const {
  const ExpandOutcome outcome = costs_->table.at(standOff).choose(~std::size_t{0}, {});
  assert(outcome.chosen);
  return outcome.chosen->size();
}

double ExpandChoices::standOffFor(std::size_t count) const {
  constexpr int kBisections = 20;
  return costs_->table.leastFor(count, kBisections).standOff;
}

}  // namespace cairn::builder

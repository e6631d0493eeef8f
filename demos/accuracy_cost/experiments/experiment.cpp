// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/experiment.h"

#include <algorithm>

#include "accuracy_cost/experiments/balance.h"
#include "accuracy_cost/experiments/error_against_time.h"
#include "accuracy_cost/experiments/expand_selection.h"
#include "accuracy_cost/experiments/frame_time.h"
#include "accuracy_cost/experiments/interruption.h"
#include "accuracy_cost/experiments/levels.h"
#include "accuracy_cost/experiments/reductions.h"
#include "accuracy_cost/experiments/sampling.h"

namespace cairn::accuracy_cost {

const std::vector<Experiment>& allExperiments() {
  static const std::vector<Experiment> kAll{
      samplingExperiment(), expandSelectionExperiment(), reductionsExperiment(),       levelsExperiment(),
      balanceExperiment(),  interruptionExperiment(),    errorAgainstTimeExperiment(), frameTimeExperiment(),
  };
  return kAll;
}

const Experiment* findExperiment(std::string_view name) {
  const auto& all = allExperiments();
  const auto found = std::ranges::find_if(all, [&](const Experiment& e) { return name == e.name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Claim> claimsOf(const Experiment& experiment, const Table& table) {
  return withLacking(experiment.judge(table), experiment.models, table.texts("model"));
}

Error about(const std::string& what, const Error& error) {
  return error.message == builder::kCancelled ? error : Error{what + ": " + error.message};
}

bool Steps::next(const std::string& what) {
  what_ = what;
  return tell(static_cast<double>(begun_++));
}

builder::ProgressCallback Steps::inside() const {
  return [this](std::string_view, double fraction) { return tell(static_cast<double>(begun_) - 1 + fraction); };
}

bool Steps::tell(double done) const {
  return !progress_ || progress_(what_, done / static_cast<double>(count_));
}

}  // namespace cairn::accuracy_cost

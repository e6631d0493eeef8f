// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy_cost/experiments/claim.h"
#include "accuracy_cost/experiments/figure.h"
#include "accuracy_cost/experiments/table.h"
#include "accuracy_cost/models/model.h"
#include "cairn/builder/progress.h"
#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// The settings that all experiments of one run share. Tables do not depend on the number of threads.
struct Settings {
  bool quick = false;      ///< few models and coarse steps: minutes instead of hours
  std::uint64_t seed = 1;  ///< of all random choices
};

/// One experiment of the thesis: its conclusion there, its measurement here, and the judgement of that measurement.
/// `judge` and `draw` are pure functions of the table, so a figure or a verdict never needs a second measurement.
struct Experiment {
  const char* name;     ///< of its files and on the command line
  const char* title;    ///< one line
  const char* section;  ///< of the thesis, figures and tables included
  const char* says;     ///< the thesis's conclusion
  const char* differs;  ///< the differences between our measurement and the thesis's, and their reasons
  std::vector<std::string> models, quickModels;

  /// Fails with `builder::kCancelled`, and for a model that is not suitable.
  Result<Table> (*measure)(const std::vector<Model>& models, const Settings& settings,
                           const builder::ProgressCallback& progress);
  std::vector<Claim> (*judge)(const Table& table);
  /// The first figure has the experiment's name.
  std::vector<Figure> (*draw)(const Table& table);
  bool isOwn = false;  ///< the thesis measures nothing like it, so it reproduces nothing
};

/// Returns the claims of an experiment's table, each with its models that the table lacks.
std::vector<Claim> claimsOf(const Experiment& experiment, const Table& table);

/// All experiments, in the order of the thesis.
const std::vector<Experiment>& allExperiments();
/// Null when no experiment has that name.
const Experiment* findExperiment(std::string_view name);

/// Puts `what` before the error's text; `builder::kCancelled` stays unchanged.
Error about(const std::string& what, const Error& error);

/// The progress of work that consists of equal steps.
class Steps {
 public:
  Steps(const builder::ProgressCallback& progress, std::size_t count) : progress_(progress), count_(count) {}

  /// Begins the next step; false when the work should end.
  bool next(const std::string& what);
  /// The callback for work inside the step.
  builder::ProgressCallback inside() const;

 private:
  bool tell(double done) const;

  const builder::ProgressCallback& progress_;
  std::size_t count_, begun_ = 0;
  std::string what_;
};

}  // namespace cairn::accuracy_cost

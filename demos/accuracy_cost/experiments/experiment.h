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

/// What all experiments of one run have in common. Tables do not depend on the number of threads.
struct Settings {
  bool quick = false;      ///< few models and coarse steps: minutes instead of hours
  std::uint64_t seed = 1;  ///< of whatever is random
};

/// One experiment of the thesis: what it is said to show, how it is measured here, and how the measurement is judged.
/// `judge` and `draw` are pure functions of the table, so that a figure or a verdict never needs a second measurement.
struct Experiment {
  const char* name;     ///< of its files and on the command line
  const char* title;    ///< one line
  const char* section;  ///< of the thesis, figures and tables included
  const char* says;     ///< what the thesis concludes
  const char* differs;  ///< where we measure something else than the thesis, and why
  std::vector<std::string> models, quickModels;

  /// Fails with `builder::kCancelled`, or for a model it cannot be made with.
  Result<Table> (*measure)(const std::vector<Model>& models, const Settings& settings,
                           const builder::ProgressCallback& progress);
  std::vector<Claim> (*judge)(const Table& table);
  /// The first figure has the experiment's name.
  std::vector<Figure> (*draw)(const Table& table);
  bool isOwn = false;  ///< beyond what the thesis measures: it reproduces nothing
};

/// What an experiment's table says, each claim with the models it is about that the table does not have.
std::vector<Claim> claimsOf(const Experiment& experiment, const Table& table);

/// All, in the order of the thesis.
const std::vector<Experiment>& allExperiments();
/// Null when there is none of that name.
const Experiment* findExperiment(std::string_view name);

/// The error with what it is about before it; `builder::kCancelled` stays as it is.
Error about(const std::string& what, const Error& error);

/// The progress of work in equal steps.
class Steps {
 public:
  Steps(const builder::ProgressCallback& progress, std::size_t count) : progress_(progress), count_(count) {}

  /// Begins the next step; false when the work is to end.
  bool next(const std::string& what);
  /// For work inside the step.
  builder::ProgressCallback inside() const;

 private:
  bool tell(double done) const;

  const builder::ProgressCallback& progress_;
  std::size_t count_, begun_ = 0;
  std::string what_;
};

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/experiment.h"
#include "cairn/builder/progress.h"
#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// An experiment, and the folder for its results.
struct RunPlan {
  const Experiment* experiment = nullptr;
  Settings settings;
  ModelSource models;
  std::filesystem::path folder;  ///< exists
  bool figures = true;
  std::string command;  ///< the command that repeats it, for the JSON
};

/// The state of an experiment after `runExperiment`.
struct RunReport {
  nlohmann::ordered_json document;   ///< as in NAME.json
  bool measured = false;             ///< false: a valid NAME.json of the same settings existed and was kept
  std::vector<std::string> leftOut;  ///< models that this machine does not have
};

/// Measures, judges and draws an experiment: `folder`/NAME.csv, the figures, then NAME.json, each written completely or
/// not at all. The JSON has digests of the other files and of itself. A JSON of the same settings, meshes and version
/// is kept if its table and itself are unchanged. Missing or changed figures are then drawn from the CSV file. Fails as
/// `readModels`, the experiment and `drawFigure` do.
Result<RunReport> runExperiment(const RunPlan& plan, const builder::ProgressCallback& progress = {});

}  // namespace cairn::accuracy_cost

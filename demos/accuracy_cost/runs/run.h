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

/// One experiment to be made into a folder.
struct RunPlan {
  const Experiment* experiment = nullptr;
  Settings settings;
  ModelSource models;
  std::filesystem::path folder;  ///< exists
  bool figures = true;
  std::string command;  ///< that makes it again, for the JSON
};

/// What there is of an experiment now.
struct RunReport {
  nlohmann::ordered_json document;   ///< as in NAME.json
  bool measured = false;             ///< false: NAME.json was there already, of the same settings, and was kept
  std::vector<std::string> leftOut;  ///< models the machine does not have
};

/// Measures, judges and draws an experiment: `folder`/NAME.csv, the figures, then NAME.json, each written whole or not
/// at all. The JSON has digests of the others and of itself: one of the same settings, meshes and version is kept if
/// its table and itself are as they were written; figures that are not, or that it lacks, are drawn from the CSV file.
/// Fails as `readModels`, the experiment and `drawFigure` do.
Result<RunReport> runExperiment(const RunPlan& plan, const builder::ProgressCallback& progress = {});

}  // namespace cairn::accuracy_cost

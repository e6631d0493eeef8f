// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "converge_report.h"
#include "options.h"

namespace cairn::frame_budget {

/// Runs the scene `converge`: records the poses, plays them for every shape, prints the table, writes the files.
Status measureConverge(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model);

/// A shape for a recording. Options and model must outlive it.
struct Entrant {
  const Options* options;
  scenes::ShapeKind shape;
  const scenes::Model* model;
};

struct ConvergeRuns {
  std::string posesHash;
  std::vector<ConvergeRun> runs;  ///< in the order of the entrants
};

/// Records the poses of the first entrant's options and plays them for all entrants, turn by turn. Fails as
/// `playRecording` does. Precondition: there is an entrant; all have one mesh and one number of bodies.
Result<ConvergeRuns> runConverge(std::span<const Entrant> entrants, const std::string& title);

}  // namespace cairn::frame_budget

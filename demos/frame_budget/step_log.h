// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/bodies/body_shape.h"
#include "scenes/world/world.h"

namespace cairn::frame_budget {

/// Every step of one shape's run.
struct LoggedRun {
  scenes::ShapeKind shape;
  std::span<const scenes::StepRecord> records;
};

/// What every step of every run did, as CSV, a line a step; what only the sphere-tree can say is left empty for the
/// others.
std::string stepLog(const std::vector<LoggedRun>& runs);

}  // namespace cairn::frame_budget

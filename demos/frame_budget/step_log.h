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

/// Returns the figures of every step of every run as CSV, one line for each step. Cells that only the sphere-tree can
/// fill are empty for other shapes.
std::string stepLog(const std::vector<LoggedRun>& runs);

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "report.h"

namespace cairn::frame_budget {

/// What every step of every run did, as CSV, a line a step; what only the sphere-tree can say is left empty for the
/// others.
std::string stepLog(const std::vector<ShapeRun>& runs);

}  // namespace cairn::frame_budget

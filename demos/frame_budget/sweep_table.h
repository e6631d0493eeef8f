// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::frame_budget {

/// Prints the header of a sweep's table on standard output; `row` names the mesh.
void printSweepHead(const nlohmann::ordered_json& row);
/// Prints a combination's line: its most important figures.
void printSweepRow(const nlohmann::ordered_json& row);

/// Returns one line for each combination: every figure of the JSON that is a single value or a group of values. Names
/// look like `narrow_phase_cpu_us_p99`. A cell is empty where a combination lacks the figure.
std::string sweepCsv(const std::vector<nlohmann::ordered_json>& rows);

}  // namespace cairn::frame_budget

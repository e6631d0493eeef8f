// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::frame_budget {

/// The line over a sweep's table on standard output; `row` says which mesh.
void printSweepHead(const nlohmann::ordered_json& row);
/// A combination's line: the most important of its figures.
void printSweepRow(const nlohmann::ordered_json& row);

/// A line for each combination: every figure of the JSON that is one value or a group of such, by names like
/// `narrow_phase_cpu_us_p99`; empty where a combination has none.
std::string sweepCsv(const std::vector<nlohmann::ordered_json>& rows);

}  // namespace cairn::frame_budget

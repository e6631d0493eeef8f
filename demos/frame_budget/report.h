// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "options.h"
#include "scenes/heap_run.h"

namespace cairn::frame_budget {

struct ShapeRun {
  scenes::ShapeKind shape;
  scenes::HeapReport report;
};

/// A table on standard output, one column a shape, and what each costs relative to the first.
void printTable(const Options& options, const scenes::SourcedTree& tree, const std::vector<ShapeRun>& runs);

/// One object for one shape, an array for several.
nlohmann::ordered_json reportToJson(const Options& options, const scenes::SourcedTree& tree,
                                    const std::vector<ShapeRun>& runs);

}  // namespace cairn::frame_budget

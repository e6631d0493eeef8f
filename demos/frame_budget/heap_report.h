// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "options.h"
#include "scenes/heap/crush_run.h"

namespace cairn::frame_budget {

/// One shape's run of `heap` or `crush`.
struct HeapRun {
  scenes::ShapeKind shape;
  scenes::HeapReport report;
  std::optional<scenes::CrushCourse> course;  ///< of a crush
};

/// A table on standard output, one column a shape, and what each costs relative to the first. `start` is that of a
/// crush.
void printHeapTable(const Options& options, const scenes::SourcedTree& tree, const scenes::CrushStart* start,
                    const std::vector<HeapRun>& runs);

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const scenes::CrushStart* start,
                              const HeapRun& run);

}  // namespace cairn::frame_budget

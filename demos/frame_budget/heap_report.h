// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "options.h"
#include "scenes/heap/crush_run.h"
#include "scenes/truth/contact_accuracy.h"

namespace cairn::frame_budget {

/// One shape's run of `heap`, `crush` or `rockfall`.
struct HeapRun {
  scenes::ShapeKind shape;
  scenes::HeapReport report;
  std::optional<scenes::CrushCourse> course;  ///< of a crush
  /// The accuracy of the last step's contacts between bodies; only on request.
  std::optional<scenes::ContactAccuracy> accuracy{};
};

/// Prints a table on standard output, one column for each shape, with costs relative to the first. `start` is that of a
/// crush, else null.
void printHeapTable(const Options& options, const scenes::SourcedTree& tree, const scenes::CrushStart* start,
                    const std::vector<HeapRun>& runs);

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const scenes::CrushStart* start,
                              const HeapRun& run);

}  // namespace cairn::frame_budget

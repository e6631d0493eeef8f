// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "heap_report.h"
#include "options.h"

namespace cairn::frame_budget {

/// Runs the scenes `heap`, `crush` and `rockfall`: simulates every shape in turn, prints the table, writes the files.
Status measureHeaps(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model);

/// Returns the start of the bodies of a crush; nothing for other scenes.
Result<std::optional<scenes::CrushStart>> startOf(const Options& options, const scenes::Model& model);

/// The additional results of a run.
struct ShapeExtras {
  std::string title{};   ///< of the progress line; empty: the shape's name
  bool picture = false;  ///< draw `options.picture`
  bool judged = false;   ///< compare the last step's contacts with the exact meshes
};

/// Simulates one shape in one of these scenes. `start` is that of a crush, else null. Fails with `builder::kCancelled`
/// when the user stops it.
Result<HeapRun> runShape(const Options& options, const scenes::Model& model, const scenes::CrushStart* start,
                         scenes::ShapeKind shape, const ShapeExtras& extras);

}  // namespace cairn::frame_budget

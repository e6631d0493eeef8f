// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "heap_report.h"
#include "options.h"

namespace cairn::frame_budget {

/// The scenes `heap`, `crush` and `rockfall`: simulates every shape in turn, prints the table, writes the files.
Status measureHeaps(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model);

/// How the bodies of a crush start; nothing for other scenes.
Result<std::optional<scenes::CrushStart>> startOf(const Options& options, const scenes::Model& model);

/// What a run gives beside its figures.
struct ShapeExtras {
  std::string title{};   ///< of the progress shown; the shape's name
  bool picture = false;  ///< draws `options.picture`
  bool judged = false;   ///< the last step's contacts are compared with the exact meshes
};

/// Simulates one shape of one of these scenes. `start` is that of a crush. Fails with `builder::kCancelled` when the
/// user stops it.
Result<HeapRun> runShape(const Options& options, const scenes::Model& model, const scenes::CrushStart* start,
                         scenes::ShapeKind shape, const ShapeExtras& extras);

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cairn/core/result.h"
#include "options.h"
#include "step_log.h"

namespace cairn::frame_budget {

/// Fails for output files that cannot be written, before any work starts.
Status checkOutputs(const Options& options);

/// Writes the files of --json and --csv: one object for one shape, an array for several.
Status writeOutputs(const Options& options, const std::vector<nlohmann::ordered_json>& objects,
                    const std::vector<LoggedRun>& runs);

/// Returns the keys that describe the run: scene, mesh, shape, tree and settings.
nlohmann::ordered_json describeRun(const Options& options, const scenes::SourcedTree& source, scenes::ShapeKind shape);

template <class T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace cairn::frame_budget

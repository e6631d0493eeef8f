// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "options.h"
#include "scenes/converge/converge_run.h"

namespace cairn::frame_budget {

/// The results of one shape on the recording.
struct ConvergeRun {
  scenes::ShapeKind shape;
  scenes::ConvergeReport report;
};

/// The first tree's narrow-phase time divided by that of the faster exact peer, GImpact or FCL.
struct ExactPeerRatio {
  scenes::ShapeKind peer;
  double median = 0, p99 = 0;
};
/// The faster peer is chosen by the median. Nothing without a tree, or without an exact peer with a measurable time.
std::optional<ExactPeerRatio> ratioToExactPeer(const std::vector<ConvergeRun>& runs);

/// Prints a table on standard output, one column for each shape. `posesHash` is the recording's.
void printConvergeTable(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                        const std::vector<ConvergeRun>& runs);

/// Returns the result of the exact check for a shape's contacts.
nlohmann::ordered_json accuracyToJson(const scenes::ContactAccuracy& accuracy);

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                              const ConvergeRun& run, const std::optional<ExactPeerRatio>& ratio);

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "options.h"
#include "scenes/converge/converge_run.h"

namespace cairn::frame_budget {

/// One shape's answers to the recording.
struct ConvergeRun {
  scenes::ShapeKind shape;
  scenes::ConvergeReport report;
};

/// The first tree's narrow phase over that of the faster exact peer, GImpact or FCL.
struct ExactPeerRatio {
  scenes::ShapeKind peer;
  double median = 0, p99 = 0;
};
/// Faster by the median. Nothing without a tree and an exact peer that took any time.
std::optional<ExactPeerRatio> ratioToExactPeer(const std::vector<ConvergeRun>& runs);

/// A table on standard output, one column a shape. `posesHash` is the recording's.
void printConvergeTable(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                        const std::vector<ConvergeRun>& runs);

/// What the exact check found of a shape's contacts.
nlohmann::ordered_json accuracyToJson(const scenes::ContactAccuracy& accuracy);

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                              const ConvergeRun& run, const std::optional<ExactPeerRatio>& ratio);

}  // namespace cairn::frame_budget

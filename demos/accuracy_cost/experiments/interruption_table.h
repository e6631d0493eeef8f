// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/interrupted_frame.h"
#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// The trees others are compared with.
inline constexpr std::array kReferences{"hubbard", "octree"};
inline constexpr const char* kCompletion = "completion";

/// What the frames of all runs came to with one tree: by frame, by interruption.
using InterruptedFrames = std::vector<std::vector<Interrupted>>;

/// What the plugin's narrow phase made of the same poses with one tree and one budget, over the frames. Lengths as
/// fractions of body size.
struct PluginOutcome {
  double operations = 0;       ///< a frame
  double worst = 0;            ///< certified, worst of a frame, mean over the frames with contacts
  double mean = 0;             ///< certified, mean of a frame, likewise
  double contacts = 0;         ///< a frame
  double unresolvedPairs = 0;  ///< share of all pairs of all frames
  double trueError = 0;        ///< of the points handed to the solver: distance from the mesh they are said to be on
  std::uint32_t missed = 0;    ///< pairs of bodies that meet and have no contact, of the frames that are checked
  double deepestMissed = 0;    ///< how deep these are in each other
};

/// One tree at work.
struct TreeOutcome {
  std::string construction;
  InterruptedFrames frames;
  std::vector<PluginOutcome> plugin;  ///< by interruption
};

/// Of a reference tree, as columns are called: "hubbard_worst_ratio".
std::string ratioColumn(const std::string& reference, const std::string& what);

Table emptyInterruptionTable();
/// The rows of a model: `operations` are the interruptions, `Budget::kUnlimited` being completion. Ratios are formed
/// frame by frame and averaged, as in the thesis.
void addInterruptionRows(Table& table, const std::string& model, const std::vector<std::uint64_t>& operations,
                         const std::vector<TreeOutcome>& trees);

}  // namespace cairn::accuracy_cost

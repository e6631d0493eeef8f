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

/// The trees that other trees are compared with.
inline constexpr std::array kReferences{"hubbard", "octree"};
inline constexpr const char* kCompletion = "completion";
/// The construction that traverses the smallest spheres and answers with those of least error (thesis 7.1.5).
inline constexpr const char* kTwoSpheres = "hybrid two spheres";

/// The results of one tree in the frames of all runs: by frame, by interruption.
using InterruptedFrames = std::vector<std::vector<Interrupted>>;

/// The plugin's results on the same poses with one tree and one budget, over the frames. Lengths are fractions of body
/// size.
struct PluginOutcome {
  double operations = 0;       ///< per frame
  double worst = 0;            ///< certified; worst of a frame, mean over the frames with contacts
  double mean = 0;             ///< certified; mean of a frame, mean over the frames with contacts
  double contacts = 0;         ///< per frame
  double unresolvedPairs = 0;  ///< share of all pairs of all frames
  double trueError = 0;        ///< distance of the solver's points from the mesh on which they should lie
  std::uint32_t missed = 0;    ///< body pairs that meet and have no contact, in the checked frames
  double deepestMissed = 0;    ///< largest penetration of these pairs
};

/// The results of one tree.
struct TreeOutcome {
  std::string construction;
  InterruptedFrames frames;
  std::vector<PluginOutcome> plugin;  ///< by interruption
};

/// Returns the name of a column of ratios to a reference tree, for example "hubbard_worst_ratio".
std::string ratioColumn(const std::string& reference, const std::string& what);

Table emptyInterruptionTable();
/// Adds the rows of a model. `operations` are the interruptions; `Budget::kUnlimited` means completion. Ratios are
/// formed frame by frame and averaged, as in the thesis.
void addInterruptionRows(Table& table, const std::string& model, const std::vector<std::uint64_t>& operations,
                         const std::vector<TreeOutcome>& trees);

}  // namespace cairn::accuracy_cost

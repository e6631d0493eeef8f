// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rockfall/ensemble/parts.h"

namespace cairn::rockfall {

struct MergeOptions {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path folder;
  bool png = false;  ///< figures as PNG too
};

struct MergeReport {
  std::uint64_t runs = 0, rocks = 0, lost = 0;
  double cpuS = 0;                    ///< of all runs
  std::vector<EffectReport> effects;  ///< summed over all runs
  std::vector<EffectRecord> did;      ///< the same effects, as well
  std::string hash;                   ///< SHA-256 over all files but PNG, hexadecimal
};

/// Writes tables, rasters, trajectories and figures of all runs in the parts, each file completely or not at all, the
/// manifest last. What is written depends on the runs alone: not on how they were shared out, nor on the folders'
/// order. Fails as `Parts::open` does, where a file cannot be written, and without rsvg-convert if PNG is wanted.
Result<MergeReport> mergeOutputs(const MergeOptions& options);

}  // namespace cairn::rockfall

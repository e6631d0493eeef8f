// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "cairn/core/result.h"
#include "scenes/world/world.h"

namespace cairn::rockfall {

/// Trajectories as CSV, one line a rock and sample: metres, seconds, the quaternion from the body's principal axes to
/// the world. Kept in memory (about 110 bytes a line) until written, so that a cancelled run leaves no file.
class TrajectoryLog {
 public:
  TrajectoryLog();
  void sample(double time, const scenes::World& world);
  /// Completely or not at all.
  Status write(const std::filesystem::path& path) const;

 private:
  std::string text_;
};

}  // namespace cairn::rockfall

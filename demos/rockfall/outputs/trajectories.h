// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

/// A trajectory of an ensemble.
struct Trajectory {
  std::uint64_t run = 0;
  std::uint32_t rock = 0;
  std::vector<TrajectorySample> samples;
};

/// Returns legacy VTK polydata for ParaView: one line for each rock, with run and rock; time, speed, energy and height
/// at its points.
std::string vtkPolydata(const std::vector<Trajectory>& trajectories);

}  // namespace cairn::rockfall

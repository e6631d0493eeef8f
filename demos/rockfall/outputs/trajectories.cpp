// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/trajectories.h"

#include <fmt/format.h>

#include <iterator>

namespace cairn::rockfall {
namespace {

template <class Each>
void addScalars(std::string& text, const std::vector<Trajectory>& trajectories, const char* name, const Each& each) {
  fmt::format_to(std::back_inserter(text), "SCALARS {} float 1\nLOOKUP_TABLE default\n", name);
  for (const Trajectory& trajectory : trajectories)
    for (const TrajectorySample& sample : trajectory.samples)
      fmt::format_to(std::back_inserter(text), "{:.6g}\n", each(sample));
}

}  // namespace

std::string vtkPolydata(const std::vector<Trajectory>& trajectories) {
  std::size_t points = 0;
  for (const Trajectory& trajectory : trajectories) points += trajectory.samples.size();
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\nCairn rock-fall trajectories, metres\nASCII\nDATASET POLYDATA\nPOINTS {} double\n",
      points);
  const auto out = std::back_inserter(text);
  for (const Trajectory& trajectory : trajectories)
    for (const TrajectorySample& s : trajectory.samples)
      fmt::format_to(out, "{:.4f} {:.4f} {:.4f}\n", s.place.x, s.place.y, s.place.z);
  fmt::format_to(out, "LINES {} {}\n", trajectories.size(), trajectories.size() + points);
  std::size_t next = 0;
  for (const Trajectory& trajectory : trajectories) {
    fmt::format_to(out, "{}", trajectory.samples.size());
    for (std::size_t i = 0; i < trajectory.samples.size(); ++i) fmt::format_to(out, " {}", next++);
    text += '\n';
  }
  fmt::format_to(out, "CELL_DATA {}\nSCALARS run int 1\nLOOKUP_TABLE default\n", trajectories.size());
  for (const Trajectory& trajectory : trajectories) fmt::format_to(out, "{}\n", trajectory.run);
  text += "SCALARS rock int 1\nLOOKUP_TABLE default\n";
  for (const Trajectory& trajectory : trajectories) fmt::format_to(out, "{}\n", trajectory.rock);
  fmt::format_to(out, "POINT_DATA {}\n", points);
  addScalars(text, trajectories, "time_s", [](const TrajectorySample& s) { return s.timeS; });
  addScalars(text, trajectories, "speed_m_per_s", [](const TrajectorySample& s) { return s.speed; });
  addScalars(text, trajectories, "energy_j", [](const TrajectorySample& s) { return s.energyJ; });
  addScalars(text, trajectories, "height_m", [](const TrajectorySample& s) { return s.heightM; });
  return text;
}

}  // namespace cairn::rockfall

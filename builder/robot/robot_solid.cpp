// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/robot_solid.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "cairn/builder/wrap.h"
#include "import/robot_surface.h"

namespace cairn::builder {

Vec3d signsOf(const Vec3d& scale) {
  return {std::copysign(1.0, scale.x), std::copysign(1.0, scale.y), std::copysign(1.0, scale.z)};
}

Result<TriangleMesh> readScaledSurface(const std::filesystem::path& path, const Vec3d& factors) {
  Result<TriangleMesh> surface = importRobotSurface(path);
  if (!surface) return surface;
  for (Vec3d& v : surface.value().vertices) {
    v = {v.x * factors.x, v.y * factors.y, v.z * factors.z};
    if (!isFinite(Vec3(v)))
      return Error{fmt::format("{}: its scale of {} x {} x {} makes coordinates infinite; correct it",
                               surface.value().name, factors.x, factors.y, factors.z)};
  }
  return surface;
}

Result<RobotSolid> solidOf(TriangleMesh surface, const ProgressCallback& progress) {
  RobotSolid result;
  result.name = surface.name;
  result.surface = std::move(surface);
  if (checkMesh(result.surface)) {
    result.solid = result.surface;
    return result;
  }
  RepairCounts counts;
  if (Result<TriangleMesh> repaired = repair(result.surface, &counts); repaired) {
    result.source = SolidSource::repaired;
    result.changes = counts.text();
    result.solid = std::move(repaired).value();
    return result;
  }
  if (progress && !progress("wrapping", 0)) return Error{std::string(kCancelled)};
  Result<Wrap> skin = wrap(result.surface, {}, progress);
  if (!skin) return skin.error();
  result.source = SolidSource::wrapped;
  result.offOriginal = skin.value().farthestUpper;
  result.solid = std::move(skin.value().mesh);
  return result;
}

}  // namespace cairn::builder

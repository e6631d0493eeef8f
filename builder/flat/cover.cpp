// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <mutex>
#include <utility>

#include "cairn/builder/import.h"
#include "flat/flat_cover.h"

namespace cairn::builder {
namespace {

/// In the order of the enumeration.
constexpr std::array<const char*, 4> kObjectives{"outer", "balanced", "inner", "volume"};

Status checkOptions(const CoverOptions& options) {
  if (options.spheres.has_value() == options.maxError.has_value())
    return Error{"a cover is made of a number of spheres or to a largest error; give one of the two"};
  if (options.spheres && (*options.spheres < 1 || *options.spheres > kMaxCoverSpheres))
    return Error{fmt::format("{} spheres cannot be placed; ask for 1 to {}", *options.spheres, kMaxCoverSpheres)};
  if (options.maxError && !(std::isfinite(*options.maxError) && *options.maxError > 0))
    return Error{fmt::format("{} is no error a cover can keep; give a length above 0", *options.maxError)};
  if (options.symmetric && options.objective == Objective::volume)
    return Error{"the objective volume keeps no mirror plane; choose outer, balanced or inner for a symmetric cover"};
  return {};
}

}  // namespace

double Cover::error(Objective objective) const {
  switch (objective) {
    case Objective::outer:
    case Objective::volume:
      return certificate.sticksOut.upper;
    case Objective::inner:
      return certificate.leavesSurface.upper;
    case Objective::balanced:
      break;
  }
  return std::max(certificate.sticksOut.upper, certificate.leavesSurface.upper);
}

Result<Cover> coverMesh(const TriangleMesh& mesh, const CoverOptions& options, const ProgressCallback& progress) {
  if (Status s = checkOptions(options); !s) return s.error();
  if (Status s = checkMesh(mesh); !s) return s.error();
  std::optional<MirrorPlane> mirror;
  if (options.symmetric) {
    mirror = mirrorPlaneOf(mesh);
    if (!mirror)
      return Error{fmt::format(
          "{}: no plane through its centre of mass mirrors the mesh within {} of its diagonal; leave out --symmetric",
          mesh.name, kMirrorTolerance)};
  }
  return FlatCover(mesh, options, mirror, progress).run();
}

Result<Objective> parseObjective(const std::string& name) {
  const auto* const found = std::find(kObjectives.begin(), kObjectives.end(), name);
  if (found == kObjectives.end())
    return Error{"there is no objective '" + name + "'; choose one of outer, balanced, inner, volume"};
  return static_cast<Objective>(found - kObjectives.begin());
}

const char* objectiveName(Objective objective) {
  return kObjectives[static_cast<std::size_t>(objective)];
}

std::vector<std::string> objectiveNames() {
  return {kObjectives.begin(), kObjectives.end()};
}

std::string coverText(const Cover& cover) {
  std::string text;
  for (std::size_t i = 0; i < cover.balls.size(); ++i) {
    const Ball& ball = cover.balls[i];
    const BallProof& proof = cover.certificate.balls[i];
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {}\n", ball.center.x, ball.center.y, ball.center.z,
                   ball.radius, proof.protrusion.upper, proof.innerRadius);
  }
  return text;
}

}  // namespace cairn::builder

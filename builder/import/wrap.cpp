// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/wrap.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "cairn/builder/import.h"
#include "import/alpha_wrap.h"
#include "import/self_intersection.h"
#include "import/settle.h"
#include "surface/farthest_point.h"
#include "surface/signed_distance.h"

namespace cairn::builder {
namespace {

Status checkOption(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  return Error{fmt::format("the wrap's {} is {} of the diagonal; choose {} to {}", name, value, least, most)};
}

/// The first triangle of `surface` that is not proved to lie strictly inside the closed mesh `skin`: it meets none of
/// the skin's triangles, so it lies on one side, and one corner tells which.
std::optional<std::uint32_t> firstOutside(const TriangleMesh& surface, const TriangleMesh& skin) {
  if (const auto pair = findCrossing(surface, skin)) return pair->first;
  const SignedDistance solid(skin);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3d corner = surface.corners(t)[0];
    if (!(solid.depth(corner) > solid.roundingBound(corner))) return t;
  }
  return std::nullopt;
}

Status prove(const TriangleMesh& surface, const TriangleMesh& skin) {
  constexpr const char* kAdvice =
      "choose a larger offset or another alpha, or move the mesh near its origin, where floats are finer";
  if (Status s = checkMesh(skin); !s)
    return Error{fmt::format("{}: its wrap is no solid ({}); {}", surface.name, s.error().message, kAdvice)};
  if (const auto t = firstOutside(surface, skin))
    return Error{fmt::format("{}: triangle {} is not inside the wrap; {}", surface.name, *t, kAdvice)};
  return {};
}

}  // namespace

Result<Wrap> wrap(const TriangleMesh& surface, const WrapOptions& options, const ProgressCallback& progress) {
  if (Status s = checkOption("alpha", options.alpha, kLeastAlpha, kMostAlpha); !s) return s.error();
  if (Status s = checkOption("offset", options.offset, kLeastOffset, kMostOffset); !s) return s.error();
  const auto cancelled = [&](double fraction) { return progress && !progress("wrapping", fraction); };
  const double diagonal = boundsOf(surface).diagonal();
  Result<TriangleMesh> skin = alphaWrap(surface, options.alpha * diagonal, options.offset * diagonal, progress);
  if (!skin) {
    if (skin.error().message == kCancelled) return skin.error();
    return Error{surface.name + ": " + skin.error().message};
  }
  skin.value().name = surface.name + ", wrapped";
  Wrap result{settled(skin.value()), 0, 0, {}};
  if (cancelled(0.5)) return Error{std::string(kCancelled)};
  if (Status s = prove(surface, result.mesh); !s) return s.error();
  if (cancelled(0.75)) return Error{std::string(kCancelled)};
  const FarthestPoint farthest =
      farthestPoint(result.mesh, SurfaceDistance(surface), {.relative = 0.01, .absolute = 1e-4 * diagonal});
  result.farthestUpper = farthest.upper;
  result.farthestLower = farthest.lower;
  result.witness = farthest.witness;
  if (cancelled(1)) return Error{std::string(kCancelled)};
  return result;
}

}  // namespace cairn::builder

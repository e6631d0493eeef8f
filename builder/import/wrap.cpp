// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// Returns the first triangle of `surface` without a proof that it lies strictly inside the closed mesh `skin`. A
/// triangle that meets none of the skin's triangles lies on one side of it, and one corner decides which.
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

/// A skin is stored in floats. Where their rounding reaches the offset, no skin can be proved. CGAL's wrap, which works
/// in doubles, may then not end.
Status checkPlace(const TriangleMesh& surface, double offset) {
  const Bounds bounds = boundsOf(surface);
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis)
    farthest = std::max({farthest, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
  const double rounding = 0x1p-24 * farthest, wide = offset * bounds.diagonal();
  if (rounding < wide) return {};
  return Error{
      fmt::format("{}: floats {:.3g} from the origin are off by {:.3g}, and the wrap's offset is {:.3g}; choose "
                  "a larger offset, or move the mesh near its origin, where floats are finer",
                  surface.name, farthest, rounding, wide)};
}

/// A proved skin, without its distance. CGAL's wrap sometimes loses a part of a surface that lies in the symmetries of
/// its bounding box. A slightly smaller offset breaks the symmetry, so a failed proof is tried twice more.
Result<TriangleMesh> provedSkin(const TriangleMesh& surface, const WrapOptions& options,
                                const ProgressCallback& progress) {
  constexpr int kAttempts = 3;
  constexpr double kSmaller = 15.0 / 16;
  const double diagonal = boundsOf(surface).diagonal();
  double offset = options.offset * diagonal;
  Status proof;
  for (int attempt = 0; attempt < kAttempts; ++attempt, offset *= kSmaller) {
    Result<TriangleMesh> skin = alphaWrap(surface, options.alpha * diagonal, offset, progress);
    if (!skin && skin.error().message == kCancelled) return skin;
    if (!skin) return Error{surface.name + ": " + skin.error().message};
    TriangleMesh mesh = settled(skin.value());
    mesh.name = surface.name + ", wrapped";
    proof = prove(surface, mesh);
    if (proof) return mesh;
  }
  return proof.error();
}

/// One skin, with its distance.
Result<Wrap> measuredSkin(const TriangleMesh& surface, const WrapOptions& options, const ProgressCallback& progress) {
  const auto cancelled = [&](double fraction) { return progress && !progress("wrapping", fraction); };
  Result<TriangleMesh> skin = provedSkin(surface, options, progress);
  if (!skin) return skin.error();
  if (cancelled(0.75)) return Error{std::string(kCancelled)};
  const double diagonal = boundsOf(surface).diagonal();
  const FarthestPoint farthest =
      farthestPoint(skin.value(), SurfaceDistance(surface), {.relative = 0.01, .absolute = 1e-4 * diagonal});
  if (cancelled(1)) return Error{std::string(kCancelled)};
  return Wrap{std::move(skin).value(), options.alpha, options.offset, farthest.upper, farthest.lower, farthest.witness};
}

/// What a skin that is `far` away is to be made with next, to be at most `wanted` away; fractions of the diagonal. The
/// distance is about the offset and a share of alpha, which features between two alphas can shift.
WrapOptions finer(WrapOptions options, double far, double wanted) {
  // The offset takes a third of the distance; the rest, less a tenth, is alpha's. A step of less than a fifth is not
  // worth another skin, one of more than ten would make a hundred times the triangles on a guess.
  constexpr double kOffsetShare = 1.0 / 3, kRoom = 0.9, kMost = 0.8, kLeast = 0.1;
  const double share = kRoom * (wanted - kOffsetShare * wanted) / std::max(far - options.offset, wanted);
  options.offset = std::max(kMinOffset, std::min(options.offset, kOffsetShare * wanted));
  options.alpha *= std::clamp(share, kLeast, kMost);
  return options;
}

}  // namespace

Result<Wrap> wrap(const TriangleMesh& surface, const WrapOptions& options, const ProgressCallback& progress) {
  if (Status s = checkOption("alpha", options.alpha, kMinAlpha, kMaxAlpha); !s) return s.error();
  if (Status s = checkOption("offset", options.offset, kMinOffset, kMaxOffset); !s) return s.error();
  const double wanted = options.maxDistance.value_or(kMaxOffset);
  if (Status s = checkOption("greatest distance", wanted, kMinWrapDistance, kMaxOffset); !s) return s.error();
  const double diagonal = boundsOf(surface).diagonal();
  for (WrapOptions tried = options;;) {
    if (Status s = checkPlace(surface, tried.offset); !s) return s.error();
    Result<Wrap> skin = measuredSkin(surface, tried, progress);
    if (!skin || !options.maxDistance || skin.value().farthestUpper <= wanted * diagonal) return skin;
    if (tried.alpha <= kMinAlpha)
      return Error{
          fmt::format("{}: the finest skin is up to {:.2g} of the diagonal away, and {:g} was asked for; allow "
                      "more, or mend the mesh with --repair",
                      surface.name, skin.value().farthestUpper / diagonal, wanted)};
    tried = finer(tried, skin.value().farthestUpper / diagonal, wanted);
    tried.alpha = std::max(tried.alpha, kMinAlpha);
  }
}

}  // namespace cairn::builder

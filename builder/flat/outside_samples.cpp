// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/outside_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balls/piece.h"
#include "surface/random_stream.h"

namespace cairn::builder {
namespace {

class LayerSampling {
 public:
  LayerSampling(const SignedDistance& solid, double reach, double edge, std::uint64_t seed)
      : solid_(solid), reach_(reach), edge_(edge), random_(seed, 0) {}

  PointSet run() {
    const Bounds& bounds = solid_.bounds();
    double half = edge_ / 2;
    while (half < bounds.diagonal() / 2 + reach_) half *= 2;
    visit(bounds.center(), half);
    return std::move(points_);
  }

 private:
  void visit(const Vec3d& middle, double half) {
    const double outside = -solid_.depth(middle), around = std::numbers::sqrt3 * half;
    if (outside + around <= 0 || outside - around > reach_) return;
    if (half <= 0.75 * edge_) {
      const Vec3d jitter(random_.uniform() - 0.5, random_.uniform() - 0.5, random_.uniform() - 0.5);
      const Vec3d point = middle + jitter * (2 * half);
      const double height = -solid_.depth(point);
      if (height > 0 && height <= reach_) points_.push(point);
      return;
    }
    const double step = half / 2;
    for (int i = 0; i < 8; ++i)
      visit(middle + Vec3d((i & 1) != 0 ? step : -step, (i & 2) != 0 ? step : -step, (i & 4) != 0 ? step : -step),
            step);
  }

  const SignedDistance& solid_;
  double reach_, edge_;
  RandomStream random_;
  PointSet points_;
};

}  // namespace

PointSet outsideSamples(const SignedDistance& solid, double reach, std::size_t count, std::uint64_t seed) {
  double area = 0;
  for (const Piece& piece : piecesOf(solid.mesh())) area += areaOf(piece);
  // The layer over a rounded body: area times height, and what its curvature adds.
  const double volume = area * reach + 4 * std::numbers::pi / 3 * reach * reach * reach;
  return LayerSampling(solid, reach, std::cbrt(volume / static_cast<double>(count)), seed).run();
}

}  // namespace cairn::builder

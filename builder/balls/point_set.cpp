// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compiled once per instruction set by Highway; the best one the machine has is chosen when the program runs. Products
// and sums stay separate (no fused multiply-add) and in one order, so that every target gives the same bits.
#include "point_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "balls/point_set.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::builder::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<double, 4>;
using V = hn::Vec<Lanes>;

/// Squared distances of a center to as many points as there are lanes.
struct DistanceSq {
  const double *HWY_RESTRICT x, *HWY_RESTRICT y, *HWY_RESTRICT z;
  Vec3d center;

  HWY_INLINE V operator()(std::size_t i) const {
    const Lanes d;
    const V dx = hn::Sub(hn::LoadU(d, x + i), hn::Set(d, center.x));
    const V dy = hn::Sub(hn::LoadU(d, y + i), hn::Set(d, center.y));
    const V dz = hn::Sub(hn::LoadU(d, z + i), hn::Set(d, center.z));
    return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
  }
  HWY_INLINE double one(std::size_t i) const {
    const double dx = x[i] - center.x, dy = y[i] - center.y, dz = z[i] - center.z;
    return dx * dx + dy * dy + dz * dz;
  }
};

/// Dot products of a direction and as many points as there are lanes.
struct Along {
  const double *HWY_RESTRICT x, *HWY_RESTRICT y, *HWY_RESTRICT z;
  Vec3d direction;

  HWY_INLINE V operator()(std::size_t i) const {
    const Lanes d;
    const V ax = hn::Mul(hn::LoadU(d, x + i), hn::Set(d, direction.x));
    const V ay = hn::Mul(hn::LoadU(d, y + i), hn::Set(d, direction.y));
    const V az = hn::Mul(hn::LoadU(d, z + i), hn::Set(d, direction.z));
    return hn::Add(hn::Add(ax, ay), az);
  }
  HWY_INLINE double one(std::size_t i) const { return x[i] * direction.x + y[i] * direction.y + z[i] * direction.z; }
};

/// The greatest of `size` values and the first index with it.
template <class Values>
HWY_INLINE PointSet::Farthest greatest(const Values& values, std::size_t size) {
  const Lanes d;
  const std::size_t lanes = hn::Lanes(d);
  // Two running maxima hide the latency of the comparison; the second pass finds the index.
  V first = hn::Set(d, values.one(0)), second = first;
  std::size_t i = 0;
  for (; i + 2 * lanes <= size; i += 2 * lanes) {
    first = hn::Max(first, values(i));
    second = hn::Max(second, values(i + lanes));
  }
  double most = hn::GetLane(hn::MaxOfLanes(d, hn::Max(first, second)));
  for (; i < size; ++i) most = std::max(most, values.one(i));
  const V wanted = hn::Set(d, most);
  for (i = 0; i + lanes <= size; i += lanes) {
    const auto at = hn::FindFirstTrue(d, hn::Eq(values(i), wanted));
    if (at >= 0) return {most, i + static_cast<std::size_t>(at)};
  }
  while (i + 1 < size && values.one(i) != most) ++i;
  return {most, i};
}

PointSet::Farthest farthest(const double* x, const double* y, const double* z, std::size_t size, const Vec3d& center) {
  return greatest(DistanceSq{x, y, z, center}, size);
}

PointSet::Farthest farthestAlong(const double* x, const double* y, const double* z, std::size_t size,
                                 const Vec3d& direction) {
  return greatest(Along{x, y, z, direction}, size);
}

void distances(const double* x, const double* y, const double* z, std::size_t size, const Vec3d& center, double offset,
               double* HWY_RESTRICT out) {
  const Lanes d;
  const DistanceSq distanceSq{x, y, z, center};
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d))
    hn::StoreU(hn::Sub(hn::Sqrt(distanceSq(i)), hn::Set(d, offset)), d, out + i);
  for (; i < size; ++i) out[i] = std::sqrt(distanceSq.one(i)) - offset;
}

}  // namespace cairn::builder::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::builder {

HWY_EXPORT(farthest);
HWY_EXPORT(farthestAlong);
HWY_EXPORT(distances);

PointSet::PointSet(std::span<const Vec3d> points) {
  for (const Vec3d& p : points) push(p);
}

void PointSet::clear() {
  x_.clear();
  y_.clear();
  z_.clear();
}

void PointSet::push(const Vec3d& point) {
  x_.push_back(point.x);
  y_.push_back(point.y);
  z_.push_back(point.z);
}

void PointSet::assign(const PointSet& from, std::span<const std::uint32_t> which) {
  for (std::vector<double> PointSet::*const axis : {&PointSet::x_, &PointSet::y_, &PointSet::z_}) {
    std::vector<double>& to = this->*axis;
    if (&from != this) to.resize(which.size());
    for (std::size_t k = 0; k < which.size(); ++k) to[k] = (from.*axis)[which[k]];
    to.resize(which.size());
  }
}

PointSet::Farthest PointSet::farthest(const Vec3d& center) const {
  assert(!empty());
  const Farthest squared = HWY_DYNAMIC_DISPATCH(farthest)(x_.data(), y_.data(), z_.data(), size(), center);
  return {std::sqrt(squared.distance), squared.index};
}

std::size_t PointSet::farthestAlong(const Vec3d& direction) const {
  assert(!empty());
  return HWY_DYNAMIC_DISPATCH(farthestAlong)(x_.data(), y_.data(), z_.data(), size(), direction).index;
}

bool PointSet::anyWithin(const Vec3d& center, double reach) const {
  // Roots are computed only where rounding may matter.
  constexpr double kSlack = 1e-12;
  const double surelySq = reach * reach * (1 - kSlack), perhapsSq = reach * reach * (1 + kSlack);
  for (std::size_t i = 0; i < size(); ++i) {
    const double dx = x_[i] - center.x, dy = y_[i] - center.y, dz = z_[i] - center.z;
    const double distanceSq = dx * dx + dy * dy + dz * dz;
    if (distanceSq > perhapsSq) continue;
    if (distanceSq <= surelySq || std::sqrt(distanceSq) <= reach) return true;
  }
  return false;
}

void PointSet::distances(const Vec3d& center, double offset, std::span<double> out) const {
  assert(out.size() == size());
  HWY_DYNAMIC_DISPATCH(distances)(x_.data(), y_.data(), z_.data(), size(), center, offset, out.data());
}

PointSet evenSample(const PointSet& points, std::size_t count, std::size_t first) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return PointSet(farthestPointSample(list, count, first));
}

}  // namespace cairn::builder
#endif

// SPDX-License-Identifier: Zlib
#include "kernel/place_vertices.h"

#include <limits>

// The instruction sets Highway compiles for, as in the core.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/place_vertices.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "kernel/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {

void place(const SurfacePatch& patch, const Similarity& to, float* columns, Box& box) {
  const Tag d;
  const std::uint32_t stride = SurfacePatch::padded(patch.vertices.size());
  const Points rows[3] = {all(to.linear.rows[0]), all(to.linear.rows[1]), all(to.linear.rows[2])};
  const Points shift = all(to.translation);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Vec3 far(kInfinity, kInfinity, kInfinity);
  Points lowest = all(far), highest = all(-far);
  for (std::uint32_t i = 0; i < stride; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points p = load(patch.vertexColumns, stride, i);
    const Points q{hn::Add(dotOf(rows[0], p), shift.x), hn::Add(dotOf(rows[1], p), shift.y),
                   hn::Add(dotOf(rows[2], p), shift.z)};
    hn::StoreU(q.x, d, columns + i);
    hn::StoreU(q.y, d, columns + stride + i);
    hn::StoreU(q.z, d, columns + 2 * stride + i);
    lowest = {hn::Min(lowest.x, q.x), hn::Min(lowest.y, q.y), hn::Min(lowest.z, q.z)};
    highest = {hn::Max(highest.x, q.x), hn::Max(highest.y, q.y), hn::Max(highest.z, q.z)};
  }
  const auto low = [&](Lanes v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(d, v)); };
  const auto high = [&](Lanes v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(d, v)); };
  box = {{low(lowest.x), low(lowest.y), low(lowest.z)}, {high(highest.x), high(highest.y), high(highest.z)}};
}

}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bullet {

HWY_EXPORT(place);

Box placeVertices(const SurfacePatch& patch, const Similarity& to, float* columns) {
  Box box;
  HWY_DYNAMIC_DISPATCH(place)(patch, to, columns, box);
  return box;
}

}  // namespace cairn::bullet
#endif  // HWY_ONCE

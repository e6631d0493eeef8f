// SPDX-License-Identifier: Zlib
#include "contacts/directional_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Cosine to the normal below which a triangle is seen edge-on: its neighbours have its edges, and its height over the
// others would be all rounding.
constexpr float kEdgeOnCosine = 1e-2F;
// Fraction of the coordinates by which sides give way, a few times what they are rounded by: what lies above a common
// side must be seen by one of its triangles.
constexpr float kSideSlack = 1.0F / (1 << 20);

std::array<Vec3, 2> acrossOf(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.6F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = normalized(cross(n, axis));
  return {u, cross(n, u)};
}

}  // namespace

GapWindow windowOfBalls(const Vec3& normal, const Vec3& upperCenter, float upperRadius, const Vec3& lowerCenter,
                        float lowerRadius, float reach) {
  GapWindow window;
  window.normal = normal;
  window.across = acrossOf(normal);
  window.center = upperRadius < lowerRadius ? upperCenter : lowerCenter;
  const Vec3 upper = upperCenter - window.center, lower = lowerCenter - window.center;
  for (std::size_t k = 0; k < 2; ++k) {
    const float u = dot(window.across[k], upper), l = dot(window.across[k], lower);
    window.lower[k] = std::max(u - upperRadius, l - lowerRadius) - reach;
    window.upper[k] = std::min(u + upperRadius, l + lowerRadius) + reach;
  }
  const float u = dot(normal, upper), l = dot(normal, lower);
  window.upperFloor = u - upperRadius - reach;
  window.upperCeiling = u + upperRadius + reach;
  window.lowerFloor = l - lowerRadius - reach;
  window.lowerCeiling = l + lowerRadius + reach;
  return window;
}

WindowView viewThrough(const GapWindow& window, const Similarity& toWindows) {
  const Mat3 axes{{window.across[0], window.across[1], window.normal}};
  return {axes * toWindows.linear, axes * (toWindows.translation - window.center)};
}

// A convex polygon that is cut by one side after the other.
class DirectionalGap::Polygon {
 public:
  static constexpr std::size_t kMaxCorners = 10;  // a triangle cut by three sides and four of the window

  explicit Polygon(const Corners& corners) : count_(corners.size()) {
    std::copy(corners.begin(), corners.end(), corners_.begin());
  }

  std::span<const Vec3> corners() const { return std::span(corners_).first(count_); }

  // Keeps the part where `inside`, linear in the position, is not negative. Convex polygons gain one corner at most.
  template <class Inside>
  void cut(const Inside& inside) {
    std::array<float, kMaxCorners> at;
    bool anyOutside = false;
    for (std::size_t i = 0; i < count_; ++i) {
      at[i] = inside(corners_[i]);
      anyOutside = anyOutside || at[i] < 0;
    }
    if (!anyOutside) return;
    std::array<Vec3, kMaxCorners> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t next = i + 1 < count_ ? i + 1 : 0;
      if (at[i] >= 0 && count < kMaxCorners) kept[count++] = corners_[i];
      if ((at[i] >= 0) != (at[next] >= 0) && count < kMaxCorners)
        kept[count++] = corners_[i] + (corners_[next] - corners_[i]) * (at[i] / (at[i] - at[next]));
    }
    std::copy(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count), corners_.begin());
    count_ = count;
  }

 private:
  std::array<Vec3, kMaxCorners> corners_;
  std::size_t count_;
};

void DirectionalGap::begin(const GapWindow& window) {
  window_ = window;
  frame_ = {window.lower, window.upper};
  uppers_.clear();
  lowers_.clear();
}

DirectionalGap::Box DirectionalGap::boxOf(const Corners& p) {
  return {{std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y})},
          {std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y})}};
}

bool DirectionalGap::addUpper(const Corners& p) {
  const Vec3 outwards = cross(p[1] - p[0], p[2] - p[0]);
  if (!(outwards.z < 0 && outwards.z * outwards.z > kEdgeOnCosine * kEdgeOnCosine * lengthSq(outwards))) return false;
  const Patch patch{p, boxOf(p), std::min({p[0].z, p[1].z, p[2].z}), outwards};
  if (!patch.box.meets(frame_)) return false;
  uppers_.push_back(patch);
  return true;
}

bool DirectionalGap::addLower(const Corners& p) {
  const Vec3 outwards = cross(p[1] - p[0], p[2] - p[0]);
  if (!(outwards.z > 0 && outwards.z * outwards.z > kEdgeOnCosine * kEdgeOnCosine * lengthSq(outwards))) return false;
  Facet facet;
  facet.box = boxOf(p);
  facet.outwards = outwards;
  if (!facet.box.meets(frame_)) return false;
  facet.ceiling = std::max({p[0].z, p[1].z, p[2].z});
  facet.anchor = p[0];
  facet.slopeU = -outwards.x / outwards.z;
  facet.slopeV = -outwards.y / outwards.z;
  const Box& box = facet.box;
  const float slack = kSideSlack * std::max({-box.from[0], -box.from[1], box.to[0], box.to[1]});
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = p[(k + 1) % 3] - p[k];
    const float norm = std::sqrt(along.x * along.x + along.y * along.y);
    if (!(norm > 0)) return false;
    const float x = -along.y / norm, y = along.x / norm;
    facet.sides[k] = {x, y, slack - x * p[k].x - y * p[k].y};
  }
  lowers_.push_back(facet);
  return true;
}

// What both cover within the window.
DirectionalGap::Polygon DirectionalGap::common(const Patch& upper, const Facet& lower) const {
  Polygon polygon(upper.corners);
  for (const Facet::Side& side : lower.sides)
    polygon.cut([&](const Vec3& q) { return side.x * q.x + side.y * q.y + side.offset; });
  for (std::size_t k = 0; k < 2; ++k) {
    const int axis = static_cast<int>(k);
    if (upper.box.from[k] < frame_.from[k]) polygon.cut([&](const Vec3& q) { return q[axis] - frame_.from[k]; });
    if (upper.box.to[k] > frame_.to[k]) polygon.cut([&](const Vec3& q) { return frame_.to[k] - q[axis]; });
  }
  return polygon;
}

bool DirectionalGap::counts(const Vec3& p, float below) const {
  return p.z >= window_.upperFloor && p.z <= window_.upperCeiling && below >= window_.lowerFloor &&
         below <= window_.lowerCeiling;
}

Vec3 DirectionalGap::inCallersFrame(const Vec3& direction) const {
  return window_.across[0] * direction.x + window_.across[1] * direction.y + window_.normal * direction.z;
}

void DirectionalGap::compare(const Patch& upper, const Facet& lower, float reach) {
  if (upper.floor - lower.ceiling >= reach || !upper.box.meets(lower.box)) return;
  const Polygon polygon = common(upper, lower);
  for (const Vec3& q : polygon.corners()) {
    const float below = lower.height(q);
    if (!counts(q, below)) continue;
    anyOverlap_ = true;
    if (q.z - below >= reach) continue;
    deepest_ = std::min(deepest_, q.z - below);
    points_.push_back({q.z - below, window_.center + inCallersFrame({q.x, q.y, 0.5F * (q.z + below)}),
                       normalized(inCallersFrame(upper.outwards)), normalized(inCallersFrame(lower.outwards)),
                       static_cast<std::uint32_t>(&upper - uppers_.data()),
                       static_cast<std::uint32_t>(&lower - lowers_.data())});
  }
}

bool DirectionalGap::overlaps(const Patch& upper, const Facet& lower) const {
  if (!upper.box.meets(lower.box)) return false;
  const Polygon polygon = common(upper, lower);
  return std::ranges::any_of(polygon.corners(), [&](const Vec3& q) { return counts(q, lower.height(q)); });
}

std::span<const GapPoint> DirectionalGap::run(float reach, float depth) {
  points_.clear();
  anyOverlap_ = false;
  deepest_ = std::numeric_limits<float>::infinity();
  for (const Patch& upper : uppers_)
    for (const Facet& lower : lowers_) compare(upper, lower, std::min(reach, deepest_ + depth));
  std::erase_if(points_, [&](const GapPoint& p) { return p.gap > deepest_ + depth; });
  return points_;
}

bool DirectionalGap::anyOverlap() const {
  if (anyOverlap_) return true;
  return std::ranges::any_of(uppers_, [&](const Patch& upper) {
    return std::ranges::any_of(lowers_, [&](const Facet& lower) { return overlaps(upper, lower); });
  });
}

}  // namespace cairn::bullet

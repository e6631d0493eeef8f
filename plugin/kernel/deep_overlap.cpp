// SPDX-License-Identifier: Zlib
#include "kernel/deep_overlap.h"

#include <algorithm>
#include <limits>

#include "kernel/contact_tuning.h"
#include "kernel/explained.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

Box boxOf(std::span<const OverlapPoint> points) {
  Box box{points[0].position, points[0].position};
  for (const OverlapPoint& p : points) box.add(p.position);
  return box;
}

FeatureKind kindOf(const OverlapPoint& point) {
  if (point.isCrossing) return point.isOfA ? FeatureKind::deepEdgeOfA : FeatureKind::deepEdgeOfB;
  return point.isOfA ? FeatureKind::deepVertexOfA : FeatureKind::deepVertexOfB;
}

// Drops contacts that push against the way out: they belong to the far side of something thin.
void dropOpposed(const OverlapRegion& region, const Vec3& normal, float near, std::vector<FeatureContact>& contacts) {
  const Box box = boxOf(region.points).grown(near);
  std::erase_if(contacts, [&](const FeatureContact& c) {
    return !isDeep(c.kind) && dot(c.normal, normal) < 0 && box.holds(c.position);
  });
}

// Whether the overlap changes little in whatever direction the bodies move: they are wrapped around each other.
bool isWrapped(const OverlapRegion& region) {
  return length(region.area) <= tuning::kNoArea * region.sum;
}

// Direction in which A leaves B. Wrapped bodies separate along the line of their middles.
Vec3 wayOut(const SurfacePair& surfaces, const OverlapRegion& region) {
  const Vec3 bodies = surfaces.a.toPair.translation - surfaces.b.toPair.translation;
  const Vec3 direction = isWrapped(region) ? bodies : -region.area;
  return unitVector(direction);
}

}  // namespace

void DeepOverlap::append(const SurfacePair& surfaces, const ContactLimits& limits,
                         std::span<const OverlapRegion> regions, std::vector<FeatureContact>& contacts) {
  for (const OverlapRegion& region : regions) {
    collectUnexplained(region, limits, contacts);
    // A nut that touches its bolt must not be pushed off it.
    const bool isTouching = isWrapped(region) && deep_.size() < region.points.size();
    if (deep_.empty() || isTouching) continue;
    const Vec3 direction = wayOut(surfaces, region);
    if (direction == Vec3() || widthAlong(direction).width() < tuning::kMinWidth * limits.contactDistance) continue;
    const Vec3 out = narrowest(surfaces, direction);
    dropOpposed(region, out, limits.contactDistance, contacts);
    appendAlong(out, limits.thickness, contacts);
  }
}

void DeepOverlap::collectUnexplained(const OverlapRegion& region, const ContactLimits& limits,
                                     std::span<const FeatureContact> explaining) {
  region_ = region.points;
  deep_.clear();
  for (const OverlapPoint& point : region.points)
    if (!isExplained(explaining, point.position, point.isOfA, limits)) deep_.push_back(point);
}

// Crossings are points of both bodies. Where only one body has points, all of them are to rise to the highest.
DeepOverlap::Width DeepOverlap::widthAlong(const Vec3& normal) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Width width{kInfinity, -kInfinity}, ofAll = width;
  for (const OverlapPoint& point : region_) {
    const float height = dot(normal, point.position);
    ofAll = {std::min(ofAll.lowest, height), std::max(ofAll.highest, height)};
    if (point.isOfA || point.isCrossing) width.lowest = std::min(width.lowest, height);
    if (!point.isOfA || point.isCrossing) width.highest = std::max(width.highest, height);
  }
  return width.lowest < kInfinity && width.highest > -kInfinity ? width : ofAll;
}

// The direction in which the overlap shrinks fastest, or a face's normal along which the region is narrower. That is
// the face normal nearest to the direction, within 50 degrees of it. So a body that is flat inside the other leaves
// along its face's normal, however much of its sides is inside too.
Vec3 DeepOverlap::narrowest(const SurfacePair& surfaces, const Vec3& way) const {
  Vec3 nearest = way;
  float cosine = tuning::kOtherDirectionCosine;
  const auto consider = [&](bool isOfA, std::uint32_t face) {
    if (face == SurfaceEdge::kNone) return;
    const PlacedSurface& side = isOfA ? surfaces.a : surfaces.b;
    const Vec3 outward = side.directionToPair(side.features().faces()[face].normal);
    const Vec3 normal = isOfA ? -outward : outward;
    if (const float c = dot(normal, way); c > cosine) {
      cosine = c;
      nearest = normal;
    }
  };
  for (const OverlapPoint& point : deep_) {
    if (point.isCrossing) {
      consider(!point.isOfA, point.face);
      continue;
    }
    const SurfaceFeatures& features = (point.isOfA ? surfaces.a : surfaces.b).features();
    for (const std::uint32_t edge : features.edgesAround(point.feature))
      for (const std::uint32_t face : features.edges()[edge].triangle) consider(point.isOfA, face);
  }
  return widthAlong(nearest).width() < widthAlong(way).width() ? nearest : way;
}

// A region around a hollow body is wider than any overlap is deep.
void DeepOverlap::appendAlong(const Vec3& normal, float thickness, std::vector<FeatureContact>& contacts) const {
  const Width width = widthAlong(normal);
  for (const OverlapPoint& point : deep_) {
    const float height = dot(normal, point.position);
    const float toEnd = point.isOfA ? width.highest - height : height - width.lowest;
    if (toEnd < tuning::kDeepPart * width.width()) continue;
    const float depth = std::min(toEnd, thickness);
    FeatureContact contact;
    contact.position = point.position + normal * ((point.isOfA ? 0.5F : -0.5F) * depth);
    contact.normal = normal;
    contact.separation = -depth;
    contact.kind = kindOf(point);
    contact.featureA = point.isOfA ? point.feature : point.face;
    contact.featureB = point.isOfA ? point.face : point.feature;
    contacts.push_back(contact);
  }
}

}  // namespace cairn::bullet

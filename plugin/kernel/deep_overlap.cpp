// SPDX-License-Identifier: Zlib
#include "kernel/deep_overlap.h"

#include <algorithm>
#include <limits>

#include "kernel/contact_tuning.h"

namespace cairn::bullet {

namespace {

bool isNear(const Box& box, const Vec3& p, float reach) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < box.lower[axis] - reach || p[axis] > box.upper[axis] + reach) return false;
  return true;
}

Box boxOf(std::span<const OverlapPoint> points) {
  Box box{points[0].position, points[0].position};
  for (const OverlapPoint& p : points) box.add(p.position);
  return box;
}

// How far a point is behind the surface that the contact knows.
float depthUnder(const FeatureContact& contact, const OverlapPoint& point) {
  const float height = dot(contact.normal, point.position - contact.position);
  const float ofPoint = point.isOfA ? height : -height;
  return -ofPoint - 0.5F * contact.separation;
}

bool explains(const FeatureContact& contact, const OverlapPoint& point, const ContactLimits& limits) {
  const float slack = tuning::kExplainedSlack * limits.contactDistance;
  const float depth = depthUnder(contact, point);
  return depth >= -slack && depth <= tuning::kExplainedDepths * std::max(-contact.separation, 0.0F) + slack;
}

}  // namespace

void DeepOverlap::append(const SurfacePair& surfaces, const ContactLimits& limits, float thickness,
                         std::span<const OverlapPoint> points, DeepDirections& kept,
                         std::vector<FeatureContact>& contacts) {
  const DeepDirections last = kept;
  kept.count = 0;
  std::size_t explaining = contacts.size();
  while (!points.empty()) {
    const auto end = std::ranges::find_if(points, [&](const OverlapPoint& p) { return p.region != points[0].region; });
    const auto region = points.first(static_cast<std::size_t>(end - points.begin()));
    points = points.subspan(region.size());
    leaveUnexplained(region, limits, std::span(contacts).first(explaining));
    if (region_.empty()) continue;
    gatherDirections(surfaces);
    if (directions_.empty()) continue;
    Width least = leastWidth(last);
    if (least.width < tuning::kLeastWidth * limits.contactDistance) continue;
    const bool isWrapped = least.width > tuning::kWrappedThicknesses * thickness &&
                           length(mean_) < tuning::kWrappedMean * static_cast<float>(faces_);
    if (isWrapped) {
      const Vec3 bodies = surfaces.a.toPair.translation - surfaces.b.toPair.translation;
      if (!(length(bodies) > 0)) continue;
      least = widthAlong(normalized(bodies));
    }
    dropOpposed(region, least.normal, limits, contacts, explaining);
    appendRegion(least, contacts);
    if (kept.count < kept.normal.size()) kept.normal[kept.count++] = least.normal;
  }
}

// What pushes against the way out is the far side of something thin.
void DeepOverlap::dropOpposed(std::span<const OverlapPoint> region, const Vec3& normal, const ContactLimits& limits,
                              std::vector<FeatureContact>& contacts, std::size_t& explaining) {
  const Box box = boxOf(region);
  const auto first = contacts.begin(), end = first + static_cast<std::ptrdiff_t>(explaining);
  const auto kept = std::remove_if(first, end, [&](const FeatureContact& c) {
    return dot(c.normal, normal) < 0 && isNear(box, c.position, limits.contactDistance);
  });
  explaining = static_cast<std::size_t>(kept - first);
  contacts.erase(kept, end);
}

void DeepOverlap::leaveUnexplained(std::span<const OverlapPoint> region, const ContactLimits& limits,
                                   std::span<const FeatureContact> explaining) {
  region_.clear();
  const Box box = boxOf(region);
  const auto isOfRegion = [&](const FeatureContact& c) {
    return isNear(box, c.position, tuning::kNearDepths * std::max(-c.separation, 0.0F) + limits.contactDistance);
  };
  for (const OverlapPoint& point : region)
    if (std::ranges::none_of(explaining, [&](const auto& c) { return isOfRegion(c) && explains(c, point, limits); }))
      region_.push_back(point);
}

void DeepOverlap::offer(const Vec3& normal) {
  mean_ += normal;
  ++faces_;
  if (std::ranges::none_of(directions_, [&](const Vec3& d) { return dot(d, normal) > tuning::kSameWay; }))
    directions_.push_back(normal);
}

// The faces that edges cross, and those around vertices inside.
void DeepOverlap::gatherDirections(const SurfacePair& surfaces) {
  directions_.clear();
  mean_ = {};
  faces_ = 0;
  const auto offerFace = [&](bool isOfA, std::uint32_t face) {
    const PlacedSurface& side = isOfA ? surfaces.a : surfaces.b;
    if (face == SurfaceEdge::kNone || side.features().faces()[face].normal == Vec3()) return;
    const Vec3 normal = side.directionToPair(side.features().faces()[face].normal);
    offer(isOfA ? -normal : normal);
  };
  for (const OverlapPoint& point : region_) {
    const SurfaceFeatures& own = (point.isOfA ? surfaces.a : surfaces.b).features();
    if (point.isCrossing) {
      offerFace(!point.isOfA, point.face);
      for (const std::uint32_t t : own.edges()[point.feature].triangle) offerFace(point.isOfA, t);
    } else {
      for (const std::uint32_t e : own.edgesAround(point.feature))
        for (const std::uint32_t t : own.edges()[e].triangle) offerFace(point.isOfA, t);
    }
  }
  if (length(mean_) > 0) {
    const Vec3 mean = normalized(mean_);
    if (std::ranges::none_of(directions_, [&](const Vec3& d) { return dot(d, mean) > tuning::kSameWay; }))
      directions_.push_back(mean);
  }
}

// Crossings are of both bodies.
DeepOverlap::Width DeepOverlap::widthAlong(const Vec3& normal) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Width width{normal, 0, kInfinity, -kInfinity};
  for (const OverlapPoint& point : region_) {
    const float height = dot(normal, point.position);
    if (point.isOfA || point.isCrossing) width.lowest = std::min(width.lowest, height);
    if (!point.isOfA || point.isCrossing) width.highest = std::max(width.highest, height);
  }
  if (width.lowest < kInfinity && width.highest > -kInfinity) {
    width.width = width.highest - width.lowest;
    return width;
  }
  // Vertices of one body alone, whose crossings are explained: they have to come up to the highest of them, or down.
  const bool isOfA = width.lowest < kInfinity;
  for (const OverlapPoint& point : region_) {
    const float height = dot(normal, point.position);
    width.lowest = std::min(width.lowest, height);
    width.highest = std::max(width.highest, height);
  }
  static_cast<void>(isOfA);
  width.width = width.highest - width.lowest;
  return width;
}

DeepOverlap::Width DeepOverlap::leastWidth(const DeepDirections& kept) const {
  Width least = widthAlong(directions_[0]);
  float merit = least.width;
  const auto compare = [&](const Vec3& normal, float share) {
    const Width width = widthAlong(normal);
    if (share * width.width >= merit) return;
    merit = share * width.width;
    least = width;
  };
  for (const Vec3& normal : directions_) compare(normal, 1);
  for (const Vec3& normal : std::span(kept.normal).first(kept.count)) {
    const bool isFaced = std::ranges::any_of(directions_, [&](const Vec3& d) { return dot(d, normal) > 0; });
    if (isFaced) compare(normal, tuning::kKeptDirection);
  }
  return least;
}

void DeepOverlap::appendRegion(const Width& least, std::vector<FeatureContact>& contacts) const {
  for (const OverlapPoint& point : region_) {
    const float height = dot(least.normal, point.position);
    const float depth = point.isOfA ? least.highest - height : height - least.lowest;
    if (depth < tuning::kDeepPart * least.width) continue;
    FeatureContact contact;
    contact.position = point.position + least.normal * ((point.isOfA ? 0.5F : -0.5F) * depth);
    contact.normal = least.normal;
    contact.separation = -depth;
    contact.kind = FeatureKind::overlap;
    contact.featureA = point.isOfA ? point.feature : point.face;
    contact.featureB = point.isOfA ? point.face : point.feature;
    contacts.push_back(contact);
  }
}

}  // namespace cairn::bullet

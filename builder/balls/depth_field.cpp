// SPDX-License-Identifier: GPL-3.0-or-later
#include "depth_field.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numbers>
#include <type_traits>
#include <vector>

namespace cairn::builder {

namespace {

constexpr std::size_t kPointsPerLeaf = 24;

/// The interface of a point set that nanoflann requires.
struct PointAdaptor {
  std::vector<Vec3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointAdaptor>, PointAdaptor, 3>;

/// Collects the points within a distance, for nanoflann, until there are too many.
struct PartsWithin {
  double withinSq;
  std::size_t most;
  std::vector<DepthField::Part>& parts;
  bool overflow = false;

  bool full() const { return true; }
  double worstDist() const { return withinSq; }
  /// False ends the search.
  bool addPoint(double distanceSq, std::size_t index) {
    if (distanceSq > withinSq) return true;
    overflow = parts.size() == most;
    if (!overflow) parts.push_back({static_cast<std::uint32_t>(index), std::sqrt(distanceSq)});
    return !overflow;
  }
};

/// Walks an octree around the solid down to cells of edge `spacing` that the offset surface may cross. Take the segment
/// from an outside cell's centre to its nearest surface point: that point is nearest to the whole segment. So the point
/// of the segment at the distance `scale` lies exactly on the offset surface.
class OffsetSampling {
 public:
  OffsetSampling(const SignedDistance& solid, double scale, double spacing, const Vec3d& center, double reach)
      : solid_(solid), scale_(scale), spacing_(spacing), center_(center), reach_(reach) {}

  std::vector<Vec3d> run() {
    double halfEdge = 0.5 * spacing_;
    while (halfEdge < reach_) halfEdge *= 2;
    visit(center_, halfEdge, solid_.closest(center_).triangle);
    return std::move(samples_);
  }

 private:
  /// `known`: a triangle that may be near.
  void visit(const Vec3d& center, double halfEdge, std::uint32_t known) {
    const double reach = std::numbers::sqrt3 * halfEdge;
    if (distance(center, center_) > reach_ + reach) return;
    const double atMost = solid_.distanceToTriangle(known, center);
    // True when the distance is so small that the whole cell is nearer than the offset surface, rounding of both
    // distances included.
    if (atMost + 4 * solid_.roundingBound(center) + reach < scale_) return;
    const SignedDistance::Answer answer = solid_.query(center, atMost);
    const double height = -answer.depth;
    const bool last = halfEdge <= 0.75 * spacing_;
    if (height + reach < scale_ || height - reach > scale_ + (last ? 0 : std::numbers::sqrt3 * spacing_)) return;
    if (last) {
      if (height >= scale_)
        samples_.push_back(answer.nearest.point + directionFrom(answer.nearest.point, center) * scale_);
      return;
    }
    const double half = 0.5 * halfEdge;
    for (int i = 0; i < 8; ++i)
      visit(center + Vec3d((i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half), half,
            answer.nearest.triangle);
  }

  const SignedDistance& solid_;
  double scale_, spacing_;
  Vec3d center_;
  double reach_;
  std::vector<Vec3d> samples_;
};

DepthField::Sample sampleOf(const SignedDistance::Answer& answer, const Vec3d& point) {
  const Vec3d away = directionFrom(answer.nearest.point, point);
  return {answer.depth, answer.depth < 0 ? -away : away};
}

}  // namespace

DepthField::Sample SolidDepth::at(const Vec3d& point) const {
  return sampleOf(solid_.query(point), point);
}

DepthField::Sample SolidDepth::at(const Vec3d& point, double depth, double moved) const {
  return sampleOf(solid_.query(point, std::abs(depth) + moved), point);
}

std::optional<double> SolidDepth::gather(const Vec3d& center, double depth, double reach, std::size_t most,
                                         std::vector<Part>& parts) const {
  return solid_.gather(center, std::abs(depth), reach, most, parts);
}

DepthField::Sample SolidDepth::atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const {
  return sampleOf(solid_.queryAmong(parts, point, moved), point);
}

struct ClosedDepth::OffsetSurface {
  PointAdaptor adaptor;
  PointTree tree;

  explicit OffsetSurface(std::vector<Vec3d> points)
      : adaptor{std::move(points)}, tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsPerLeaf)) {
    // Points in the order of the leaves, so that a search reads memory in sequence.
    std::vector<Vec3d> byLeaf;
    byLeaf.reserve(adaptor.points.size());
    for (auto& index : tree.vAcc) {
      byLeaf.push_back(adaptor.points[index]);
      index = static_cast<std::remove_reference_t<decltype(index)>>(byLeaf.size() - 1);
    }
    adaptor.points = std::move(byLeaf);
  }
};

ClosedDepth::ClosedDepth(const SignedDistance& solid, double scale, double spacing, const Vec3d& center, double reach)
    : scale_(scale) {
  assert(scale > 0 && spacing > 0 && reach > 0);
  offset_ = std::make_unique<OffsetSurface>(OffsetSampling(solid, scale, spacing, center, reach).run());
}

bool ClosedDepth::usable() const {
  return !offset_->adaptor.points.empty();
}

ClosedDepth::~ClosedDepth() = default;

DepthField::Sample ClosedDepth::at(const Vec3d& point) const {
  return nearestTo(point, std::numeric_limits<double>::infinity());
}

DepthField::Sample ClosedDepth::at(const Vec3d& point, double depth, double moved) const {
  const double within = (depth + scale_ + moved) * (1 + kRoundingRoom) + kRoundingRoom * scale_;
  return nearestTo(point, within * within);
}

/// Precondition: a sample of the offset surface is nearer than that.
DepthField::Sample ClosedDepth::nearestTo(const Vec3d& point, double withinSq) const {
  assert(usable());
  const std::array<double, 3> query{point.x, point.y, point.z};
  std::size_t index = 0;
  double distanceSq = 0;
  nanoflann::KNNResultSet<double> result(1);
  result.init(&index, &distanceSq);
  distanceSq = withinSq;  // the result set compares with the value it will overwrite
  offset_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  return sampleFrom(index, distanceSq, point);
}

DepthField::Sample ClosedDepth::sampleFrom(std::size_t nearest, double distanceSq, const Vec3d& point) const {
  return {std::sqrt(distanceSq) - scale_, directionFrom(offset_->adaptor.points[nearest], point)};
}

std::optional<double> ClosedDepth::gather(const Vec3d& center, double depth, double reach, std::size_t most,
                                          std::vector<Part>& parts) const {
  assert(usable());
  parts.clear();
  const double least = depth + scale_;
  const double within = (least + 2 * reach) * (1 + kRoundingRoom);
  const std::array<double, 3> query{center.x, center.y, center.z};
  PartsWithin result{within * within, most, parts};
  offset_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  if (result.overflow) return std::nullopt;
  return within;
}

DepthField::Sample ClosedDepth::atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const {
  double leastSq = std::numeric_limits<double>::infinity(), reach = leastSq;
  std::size_t nearest = 0;
  bool tied = true;
  for (const Part& part : parts) {
    if (part.distance > reach) continue;
    const double distanceSq = lengthSq(point - offset_->adaptor.points[part.index]);
    if (distanceSq > leastSq) continue;
    tied = distanceSq == leastSq;
    leastSq = distanceSq;
    nearest = part.index;
    reach = (std::sqrt(leastSq) + moved) * (1 + kRoundingRoom);
  }
  return tied ? at(point) : sampleFrom(nearest, leastSq, point);
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/signed_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <cmath>

#include "surface/pseudonormals.h"
#include "surface/surface_distance.h"
#include "surface/triangle_hierarchy.h"
#include "surface/winding_number.h"

namespace cairn::builder {

namespace {

/// A pseudonormal is a sum of unit normals. Each is rounded by a few 2^-52 over the sine of its triangle's angle. At
/// edges and corners sharper than a hundred-thousandth of a degree they nearly cancel, and mostly rounding remains. A
/// product with the pseudonormal below this fraction of the offset decides nothing. The fraction covers triangles with
/// angles down to 2^-14.
constexpr double kSignInDoubt = 0x1p-36;

}  // namespace

struct SignedDistance::Hierarchy {
  explicit Hierarchy(const TriangleMesh& m) : mesh(&m), bounds(boundsOf(m)), triangles(m), pseudonormals(m) {}

  const TriangleMesh* mesh;
  Bounds bounds;
  TriangleHierarchy triangles;
  Pseudonormals pseudonormals;
};

SignedDistance::SignedDistance(const TriangleMesh& mesh) : hierarchy_(std::make_unique<Hierarchy>(mesh)) {}
SignedDistance::~SignedDistance() = default;
SignedDistance::SignedDistance(SignedDistance&&) noexcept = default;
SignedDistance& SignedDistance::operator=(SignedDistance&&) noexcept = default;

const TriangleMesh& SignedDistance::mesh() const {
  return *hierarchy_->mesh;
}

const Bounds& SignedDistance::bounds() const {
  return hierarchy_->bounds;
}

SignedDistance::Answer SignedDistance::query(const Vec3d& query) const {
  assert(isFinite(query));
  return answerAt(nearestTriangle(hierarchy_->triangles, query), query);
}

SignedDistance::Answer SignedDistance::query(const Vec3d& query, double atMost) const {
  assert(isFinite(query));
  // The rounding of the bound's own distance, of the compared distance, and twice that for boxes.
  const double guarded = atMost * (1 + 0x1p-50) + 4 * roundingBound(query);
  return answerAt(nearestTriangle(hierarchy_->triangles, query, guarded), query);
}

std::optional<double> SignedDistance::gather(const Vec3d& center, double distance, double reach, std::size_t most,
                                             std::vector<NearPacket>& parts) const {
  // For any point within reach of the centre, a triangle farther from the centre than distance + 2 reach is farther
  // than the triangle nearest to the centre. Four distances take part, each rounded. Twice their rounding also covers
  // the reach's own.
  const double guard = 8 * roundingBound(center + Vec3d{reach, reach, reach});
  const double within = distance + 2 * reach + guard;
  parts.clear();
  if (!packetsWithin(hierarchy_->triangles, center, within, most, parts)) return std::nullopt;
  return within;
}

SignedDistance::Answer SignedDistance::queryAmong(std::span<const NearPacket> parts, const Vec3d& point,
                                                  double moved) const {
  // Covers the rounding of the packets' distances from the centre and of the compared distance; doubled for the
  // decision itself.
  const double rounding = roundingBound(point);
  const double guarded = moved * (1 + 0x1p-50) + 8 * rounding;
  const NearestAmong nearest = nearestAmong(hierarchy_->triangles, parts, point, guarded, 4 * rounding);
  return nearest.decided ? answerAt(nearest.place, point) : query(point, nearest.distance);
}

SignedDistance::Answer SignedDistance::answerAt(TriangleHierarchy::Place place, const Vec3d& query) const {
  const TrianglePacket& packet = hierarchy_->triangles.packet(place.packet);
  const TrianglePacket::Nearest nearest = packet.nearest(place.lane, query);
  const std::uint32_t triangle = packet.triangle[place.lane];
  const Vec3d& normal = hierarchy_->pseudonormals.at(mesh(), triangle, nearest.feature);
  const double distance = length(nearest.offset);
  bool outside = dot(nearest.offset, normal) > 0;
  if (hierarchy_->pseudonormals.besideSharpEdge(triangle) && distance > roundingBound(query))
    outside = isOutsideByAll(query, distance);
  return {{query - nearest.offset, distance, triangle}, outside ? -distance : distance};
}

bool SignedDistance::isOutsideByAll(const Vec3d& query, double distance) const {
  const double within = distance + 4 * roundingBound(query);
  std::vector<NearPacket> parts;
  packetsWithin(hierarchy_->triangles, query, within, hierarchy_->mesh->triangles.size(), parts);
  std::optional<bool> outside;
  for (const NearPacket& part : parts) {
    const TrianglePacket& packet = hierarchy_->triangles.packet(part.index);
    for (int lane = 0; lane < TrianglePacket::kWidth; ++lane) {
      const TrianglePacket::Nearest nearest = packet.nearest(lane, query);
      const double there = length(nearest.offset);
      if (there > within) continue;
      const double along =
          dot(nearest.offset, hierarchy_->pseudonormals.at(mesh(), packet.triangle[lane], nearest.feature));
      const bool agrees = std::abs(along) > kSignInDoubt * there && outside.value_or(along > 0) == (along > 0);
      if (!agrees) return windingNumber(mesh(), query) < 0.5;
      outside = along > 0;
    }
  }
  return outside.value_or(true);
}

double SignedDistance::distanceToTriangle(std::uint32_t triangle, const Vec3d& point) const {
  const TriangleHierarchy::Place place = hierarchy_->triangles.placeOf(triangle);
  return length(hierarchy_->triangles.packet(place.packet).nearest(place.lane, point).offset);
}

double SignedDistance::roundingBound(const Vec3d& query) const {
  return distanceRoundingBound(bounds(), query);
}

SurfacePoint SignedDistance::closest(const Vec3d& query) const {
  return this->query(query).nearest;
}

double SignedDistance::depth(const Vec3d& query) const {
  return this->query(query).depth;
}

void SignedDistance::depths(std::span<const Vec3d> queries, std::span<double> out) const {
  assert(queries.size() == out.size());
  constexpr std::size_t kGrain = 256;  // some 0.2 ms of work, far above the cost of a task
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) out[i] = depth(queries[i]);
  });
}

}  // namespace cairn::builder

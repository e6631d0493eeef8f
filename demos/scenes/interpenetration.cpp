// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/interpenetration.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "scenes/exact_check.h"

namespace cairn::scenes {
namespace {

struct Box {
  Vec3d lower, upper;

  bool overlaps(const Box& o) const {
    for (int axis = 0; axis < 3; ++axis)
      if (lower[axis] > o.upper[axis] || o.lower[axis] > upper[axis]) return false;
    return true;
  }
};

struct PlacedBody {
  Placement worldFromBody;
  std::vector<Vec3d> vertices;  // world frame
  Box box;
};

/// Bullet's rotation to double, its columns made orthonormal again: the check must not see single precision's stretch.
Placement placementOf(const btTransform& pose) {
  const btMatrix3x3& m = pose.getBasis();
  const Vec3d x = normalized(fromBullet(m.getColumn(0)));
  const Vec3d yRaw = fromBullet(m.getColumn(1));
  const Vec3d y = normalized(yRaw - x * dot(x, yRaw));
  const Mat3d columns{{x, y, cross(x, y)}};
  return {transpose(columns), fromBullet(pose.getOrigin())};
}

PlacedBody place(const btRigidBody& body, const Model& model) {
  PlacedBody placed{placementOf(body.getWorldTransform()), {}, {}};
  const double infinity = std::numeric_limits<double>::infinity();
  placed.box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Vec3d& v : model.vertices) {
    const Vec3d p = placed.vertices.emplace_back(placed.worldFromBody * v);
    for (int axis = 0; axis < 3; ++axis) {
      placed.box.lower[axis] = std::min(placed.box.lower[axis], p[axis]);
      placed.box.upper[axis] = std::max(placed.box.upper[axis], p[axis]);
    }
  }
  return placed;
}

/// Collects values given as lengths, reports fractions of body size.
class SpreadOfLengths {
 public:
  void add(double length) {
    sum_ += length;
    max_ = std::max(max_, length);
    ++count_;
  }
  Spread over(double size) const { return {count_ ? sum_ / count_ / size : 0, max_ / size, count_}; }

 private:
  double sum_ = 0, max_ = 0;
  std::uint32_t count_ = 0;
};

double clearance(const PlacedBody& body, const HalfSpace& face) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : body.vertices) least = std::min(least, dot(face.normal, p) - face.offset);
  return least;
}

class HeapCheck {
 public:
  HeapCheck(const Heap& heap, const ExactSurface& surface) : heap_(heap), surface_(surface) {
    for (const btRigidBody* body : heap.world().bodies()) bodies_.push_back(place(*body, heap.model()));
  }

  Interpenetration run() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies_.size(); ++j)
        if (bodies_[i].box.overlaps(bodies_[j].box) || isLoaded(i, j)) checkPair(i, j);
      checkAgainstPit(i);
    }
    const double size = heap_.model().size;
    return {depth_.over(size), gap_.over(size), pitDepth_.over(size), pitGap_.over(size)};
  }

 private:
  bool isLoaded(std::size_t i, std::size_t j) const {
    return heap_.world().loads().isLoaded(static_cast<int>(i), static_cast<int>(j));
  }

  void checkPair(std::size_t i, std::size_t j) {
    const Placement jFromI = bodies_[j].worldFromBody.inverse() * bodies_[i].worldFromBody;
    const double tolerance = kDepthToleranceFraction * heap_.model().size;
    const double depth = std::max(penetration(surface_, surface_, jFromI, tolerance),
                                  penetration(surface_, surface_, jFromI.inverse(), tolerance));
    if (depth > 0) depth_.add(depth);
    if (isLoaded(i, j)) gap_.add(depth > 0 ? 0 : surfaceDistance(surface_, surface_, jFromI));
  }

  void checkAgainstPit(std::size_t i) {
    const auto faces = heap_.pit().faces();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const double room = clearance(bodies_[i], faces[f]);
      if (room < 0) pitDepth_.add(-room);
      if (heap_.world().loads().isLoaded(World::staticNumber(f), static_cast<int>(i))) pitGap_.add(std::max(0.0, room));
    }
  }

  const Heap& heap_;
  const ExactSurface& surface_;
  std::vector<PlacedBody> bodies_;
  SpreadOfLengths depth_, gap_, pitDepth_, pitGap_;
};

}  // namespace

Result<Interpenetration> measureInterpenetration(const Heap& heap) {
  const auto surface = ExactSurface::create(heap.model().vertices, heap.model().triangles);
  if (!surface) return surface.error();
  return HeapCheck(heap, surface.value()).run();
}

}  // namespace cairn::scenes

// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_pile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "scenes/truth/placed_body.h"

namespace cairn::hard {
namespace {

constexpr double kToleranceFraction = 0.001;  // of the diagonal; the limits asked for are thirty times as much

scenes::ExactSurface surfaceOf(const test::Solid& solid) {
  auto surface = scenes::ExactSurface::create(solid.vertices, solid.triangles);
  if (!surface) throw std::runtime_error(surface.error().message);
  return std::move(surface).value();
}

scenes::Box boxOf(const std::vector<Vec3d>& points) {
  scenes::Box box{points.front(), points.front()};
  for (const Vec3d& p : points) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y), std::min(box.lower.z, p.z)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y), std::max(box.upper.z, p.z)};
  }
  return box;
}

scenes::PlacedBody place(const btTransform& pose, const test::Solid& solid) {
  scenes::PlacedBody placed{scenes::placementOf(pose), {}, {}};
  for (const Vec3d& v : solid.vertices) placed.vertices.push_back(placed.worldFromBody * v);
  placed.box = boxOf(placed.vertices);
  return placed;
}

double depthUnder(const btCollisionObject& plane, const scenes::PlacedBody& body) {
  const auto& shape = static_cast<const btStaticPlaneShape&>(*plane.getCollisionShape());
  const scenes::Placement planeFromWorld = scenes::placementOf(plane.getWorldTransform()).inverse();
  const Vec3d normal = scenes::fromBullet(shape.getPlaneNormal());
  double deepest = 0;
  for (const Vec3d& v : body.vertices)
    deepest = std::max(deepest, double(shape.getPlaneConstant()) - dot(normal, planeFromWorld * v));
  return deepest;
}

}  // namespace

ExactPile::ExactPile(const test::Solid& solid) : solid_(solid), surface_(surfaceOf(solid)), tolerance_(0) {
  const scenes::Box box = boxOf(solid.vertices);
  tolerance_ = kToleranceFraction * length(box.upper - box.lower);
}

MeetingPair ExactPile::deepest(const Pile& pile) const {
  std::vector<scenes::PlacedBody> placed;
  for (const btRigidBody* body : pile.bodies()) placed.push_back(place(body->getWorldTransform(), solid_));
  MeetingPair deepest;
  for (int i = 0; i < int(placed.size()); ++i) {
    for (int k = 0; k < int(pile.planes().size()); ++k)
      if (const double depth = depthUnder(*pile.planes()[std::size_t(k)], placed[std::size_t(i)]);
          depth > deepest.depth)
        deepest = {-1 - k, i, depth};
    for (int j = i + 1; j < int(placed.size()); ++j) {
      const scenes::PlacedBody &a = placed[std::size_t(i)], &b = placed[std::size_t(j)];
      if (!a.box.overlaps(b.box)) continue;
      const double depth = scenes::mutualPenetration(
          surface_, surface_, scenes::relativePlacement(a.worldFromBody, b.worldFromBody), tolerance_, deepest.depth);
      if (depth > deepest.depth) deepest = {i, j, depth};
    }
  }
  return deepest;
}

}  // namespace cairn::hard

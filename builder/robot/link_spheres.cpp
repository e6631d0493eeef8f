// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/link_spheres.h"

#include <algorithm>
#include <cmath>

#include "robot/primitive_meshes.h"

namespace cairn::builder {
namespace {

/// Rounding of a pose between two links, as a part of the lengths involved: each joint on the way adds some 2^-50 of
/// them, and no robot has a thousand joints between two links.
constexpr double kPoseRounding = 1e-12;

double distanceToShape(const CollisionShape& shape, const Vec3d& point) {
  const Vec3d p = shape.origin.inverse()(point);
  if (shape.kind == CollisionKind::box) {
    const auto beyond = [](double x, double edge) { return std::max(0.0, std::abs(x) - 0.5 * edge); };
    return length(Vec3d{beyond(p.x, shape.size.x), beyond(p.y, shape.size.y), beyond(p.z, shape.size.z)});
  }
  const double across = std::max(0.0, std::hypot(p.x, p.y) - shape.size.x);
  const double along = std::max(0.0, std::abs(p.z) - 0.5 * shape.size.y);
  return std::hypot(across, along);
}

std::vector<CollisionShape> keptShapes(const RobotLink& link, const std::vector<RobotPart>& parts) {
  std::vector<CollisionShape> shapes;
  for (const RobotPart& part : parts)
    if (!part.solid && link.collisions[part.collision].kind != CollisionKind::sphere)
      shapes.push_back(link.collisions[part.collision]);
  return shapes;
}

std::vector<TriangleMesh> surfacesOf(const std::vector<CollisionShape>& shapes) {
  std::vector<TriangleMesh> surfaces;
  for (const CollisionShape& shape : shapes) {
    surfaces.push_back(keptSurface(shape));
    for (Vec3d& v : surfaces.back().vertices) v = shape.origin(v);
  }
  return surfaces;
}

std::vector<Ball> allBalls(const std::vector<RobotPart>& parts) {
  std::vector<Ball> balls;
  for (const RobotPart& part : parts) balls.insert(balls.end(), part.balls.begin(), part.balls.end());
  return balls;
}

/// Around the middle of the centres' box; not the smallest.
Ball boundOf(const std::vector<Ball>& balls) {
  if (balls.empty()) return {};
  Vec3d lower = balls.front().center, upper = lower;
  for (const Ball& ball : balls)
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], ball.center[axis]);
      upper[axis] = std::max(upper[axis], ball.center[axis]);
    }
  Ball bound{(lower + upper) * 0.5, 0, 0};
  for (const Ball& ball : balls)
    bound.radius = std::max(bound.radius, distance(ball.center, bound.center) + ball.radius);
  return bound;
}

bool meet(const Ball& a, const Ball& b, double slack) {
  const double reach = a.radius + b.radius + slack;
  return lengthSq(a.center - b.center) <= reach * reach;
}

}  // namespace

LinkSpheres::LinkSpheres(const RobotLink& link, const std::vector<RobotPart>& parts)
    : balls_(allBalls(parts)),
      shapes_(keptShapes(link, parts)),
      shapeSurface_(surfacesOf(shapes_)),
      bound_(boundOf(balls_)) {}

bool LinkSpheres::touchesShapes(const LinkSpheres& other, const RigidPose& pose, double slack) const {
  return std::any_of(other.balls_.begin(), other.balls_.end(), [&](const Ball& ball) {
    const Vec3d center = pose(ball.center);
    return std::any_of(shapes_.begin(), shapes_.end(), [&](const CollisionShape& shape) {
      return distanceToShape(shape, center) <= ball.radius + slack;
    });
  });
}

bool LinkSpheres::touches(const LinkSpheres& other, const RigidPose& pose) const {
  const double size = length(pose.translation) + length(bound_.center) + bound_.radius + length(other.bound_.center) +
                      other.bound_.radius;
  const double slack = kPoseRounding * size;
  if (touchesShapes(other, pose, slack) || other.touchesShapes(*this, pose.inverse(), slack)) return true;
  if (shapeSurface_.meets(other.shapeSurface_, pose)) return true;
  const Ball bound{pose(other.bound_.center), other.bound_.radius, 0};
  if (balls_.empty() || other.balls_.empty() || !meet(bound_, bound, slack)) return false;
  std::vector<Ball> near;
  std::copy_if(balls_.begin(), balls_.end(), std::back_inserter(near),
               [&](const Ball& a) { return meet(a, bound, slack); });
  return std::any_of(other.balls_.begin(), other.balls_.end(), [&](const Ball& ball) {
    const Ball b{pose(ball.center), ball.radius, 0};
    return std::any_of(near.begin(), near.end(), [&](const Ball& a) { return meet(a, b, slack); });
  });
}

}  // namespace cairn::builder

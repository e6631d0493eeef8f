// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/pit.h"

namespace cairn::scenes {
namespace {

/// Thickness of ground and walls made of boxes, metres: several times the path of a falling body in one step.
constexpr double kBoxThickness = 2;

}  // namespace

Pit::Pit(double halfWidth) : halfWidth_(halfWidth) {}

std::array<HalfSpace, 5> Pit::faces() const {
  return {{{{0, 0, 1}, 0},
           {{1, 0, 0}, -halfWidth_},
           {{-1, 0, 0}, -halfWidth_},
           {{0, 1, 0}, -halfWidth_},
           {{0, -1, 0}, -halfWidth_}}};
}

void Pit::build(World& world, ShapeKind bodies, double height) {
  const bool planes = isSphereTree(bodies) || bodies == ShapeKind::gimpact;
  planes ? addPlanes(world) : addBoxes(world, height);
}

void Pit::addPlanes(World& world) {
  for (const HalfSpace& face : faces()) {
    shapes_.push_back(std::make_unique<btStaticPlaneShape>(toBullet(face.normal), static_cast<btScalar>(face.offset)));
    world.addBody(*shapes_.back(), btTransform::getIdentity(), 0, btVector3(0, 0, 0));
  }
}

void Pit::addBoxes(World& world, double height) {
  const double outer = halfWidth_ + kBoxThickness;
  for (const HalfSpace& face : faces()) {
    const bool isGround = face.normal.z > 0;
    Vec3d half{outer, outer, isGround ? kBoxThickness / 2 : height / 2 + kBoxThickness};
    Vec3d center = face.normal * (face.offset - kBoxThickness / 2);
    for (int axis = 0; axis < 2; ++axis)
      if (face.normal[axis] != 0) half[axis] = kBoxThickness / 2;
    if (!isGround) center.z = height / 2;
    shapes_.push_back(std::make_unique<btBoxShape>(toBullet(half)));
    world.addBody(*shapes_.back(), btTransform(btQuaternion::getIdentity(), toBullet(center)), 0, btVector3(0, 0, 0));
  }
}

}  // namespace cairn::scenes

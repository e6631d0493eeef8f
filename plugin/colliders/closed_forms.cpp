// SPDX-License-Identifier: Zlib
#include "colliders/closed_forms.h"

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

// A point in the half-plane on one side of the axis.
struct Flat {
  float out = 0, up = 0;
};

// The outline that is rotated around the axis, counterclockwise from its lowest point on the axis to its highest.
struct Profile {
  int axis = 1;
  std::array<Flat, 4> corners;
  std::size_t count = 0;
  float margin = 0;
};

std::optional<Profile> profileOf(const btConvexShape& shape) {
  switch (shape.getShapeType()) {
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      const auto half = static_cast<float>(capsule.getHalfHeight());
      return Profile{capsule.getUpAxis(), {{{0, -half}, {0, half}}}, 2, static_cast<float>(capsule.getRadius())};
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      const auto margin = static_cast<float>(cylinder.getMargin());
      const float half =
          std::max(static_cast<float>(cylinder.getHalfExtentsWithoutMargin()[cylinder.getUpAxis()]), 0.0F);
      const float radius = std::max(static_cast<float>(cylinder.getRadius()) - margin, 0.0F);
      return Profile{cylinder.getUpAxis(), {{{0, -half}, {radius, -half}, {radius, half}, {0, half}}}, 4, margin};
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      const float half = 0.5F * static_cast<float>(cone.getHeight());
      const auto radius = static_cast<float>(cone.getRadius());
      return Profile{
          cone.getConeUpIndex(), {{{0, -half}, {radius, -half}, {0, half}}}, 3, static_cast<float>(cone.getMargin())};
    }
    default:
      return {};
  }
}

float dotOf(const Flat& a, const Flat& b) {
  return a.out * b.out + a.up * b.up;
}

// Below 1e-19 a float's square has few digits or none: such a length counts as none.
float lengthOf(const Flat& v) {
  const float squared = dotOf(v, v);
  return squared >= std::numeric_limits<float>::min() ? std::sqrt(squared) : 0;
}

struct FlatPoint {
  Flat normal;
  float distance = 0;
};

// Without the margin. Inside, gives the nearest side; outside, the nearest point of the sides that face the point.
FlatPoint nearestOn(std::span<const Flat> corners, const Flat& p) {
  FlatPoint inside{{}, -std::numeric_limits<float>::infinity()}, outside{{}, std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Flat side{corners[i + 1].out - corners[i].out, corners[i + 1].up - corners[i].up};
    const float length = lengthOf(side);
    if (!(length > 0)) continue;
    const Flat normal{side.up / length, -side.out / length}, to{p.out - corners[i].out, p.up - corners[i].up};
    const float height = dotOf(normal, to), along = dotOf(side, to) / (length * length);
    if (height > inside.distance) inside = {normal, height};
    if (height <= 0 || height >= outside.distance) continue;
    const float part = std::clamp(along, 0.0F, 1.0F);
    const Flat offset{to.out - side.out * part, to.up - side.up * part};
    const float distance = part == along ? height : lengthOf(offset);
    if (distance >= outside.distance) continue;
    const bool isCorner = part != along && distance > 0;
    outside = {isCorner ? Flat{offset.out / distance, offset.up / distance} : normal, distance};
  }
  if (outside.distance < std::numeric_limits<float>::infinity()) return outside;
  if (inside.distance > -std::numeric_limits<float>::infinity()) return inside;
  // All corners coincide.
  const Flat offset{p.out - corners[0].out, p.up - corners[0].up};
  const float distance = lengthOf(offset);
  return distance > 0 ? FlatPoint{{offset.out / distance, offset.up / distance}, distance} : FlatPoint{{1, 0}, 0};
}

}  // namespace

NearestPoint nearestOnBox(const Vec3& halfExtents, const Vec3& p) {
  Vec3 clamped;
  for (int axis = 0; axis < 3; ++axis) clamped[axis] = std::clamp(p[axis], -halfExtents[axis], halfExtents[axis]);
  const Vec3 out = p - clamped;
  if (out != Vec3()) return {clamped, unitVector(out), length(out)};
  int face = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (halfExtents[axis] - std::abs(p[axis]) < halfExtents[face] - std::abs(p[face])) face = axis;
  NearestPoint nearest{p, {}, std::abs(p[face]) - halfExtents[face]};
  nearest.normal[face] = std::copysign(1.0F, p[face]);
  nearest.point[face] = std::copysign(halfExtents[face], p[face]);
  return nearest;
}

NearestPoint nearestOnSphere(float radius, const Vec3& p) {
  const float fromCenter = length(p);
  const Vec3 normal = p != Vec3() ? unitVector(p) : Vec3(0, 0, 1);
  return {normal * radius, normal, fromCenter - radius};
}

std::optional<NearestPoint> nearestOnRound(const btConvexShape& shape, const Vec3& p) {
  const std::optional<Profile> profile = profileOf(shape);
  if (!profile) return {};
  Vec3 outward = p;
  outward[profile->axis] = 0;
  const float out = length(outward);
  // On the axis all directions away from it are equal.
  if (out > 0)
    outward = unitVector(outward);
  else
    outward[(profile->axis + 1) % 3] = 1;
  const FlatPoint flat = nearestOn(std::span(profile->corners).first(profile->count), {out, p[profile->axis]});
  NearestPoint nearest;
  nearest.normal = outward * flat.normal.out;
  nearest.normal[profile->axis] = flat.normal.up;
  nearest.distance = flat.distance - profile->margin;
  nearest.point = p - nearest.normal * nearest.distance;
  return nearest;
}

bool isClosedForm(const btConvexShape& shape) {
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
    case SPHERE_SHAPE_PROXYTYPE:
    case CAPSULE_SHAPE_PROXYTYPE:
    case CYLINDER_SHAPE_PROXYTYPE:
    case CONE_SHAPE_PROXYTYPE:
      return true;
    default:
      return false;
  }
}

}  // namespace cairn::bullet

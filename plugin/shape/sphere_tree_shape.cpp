// SPDX-License-Identifier: Zlib
#include "cairn/bullet/sphere_tree_shape.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "cairn/core/log.h"
#include "cairn/core/tree_refit.h"
#include "placement/bullet_math.h"
#include "queries/leaf_balls.h"
#include "queries/region_balls.h"
#include "shape/extreme_points.h"
#include "shape/unserved.h"

namespace cairn::bullet {

namespace {

// Where it is tells the class: nobody else's name is there.
constexpr char kTreeName[] = "CairnSphereTree";

// As many digits as it takes to tell two numbers apart.
std::string exactly(btScalar number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", std::numeric_limits<btScalar>::max_digits10, double(number));
  return text.data();
}

Result<btScalar> uniformScale(const btVector3& scaling) {
  const btScalar x = scaling.x(), y = scaling.y(), z = scaling.z();
  if (x == y && y == z) {
    if (x > 0 && std::isfinite(x)) return x;
    return Error{"a sphere-tree shape cannot be scaled by " + exactly(x) + ": give a positive, finite scale"};
  }
  const btScalar mean = x / 3 + y / 3 + z / 3;
  const btScalar most = std::max({std::abs(x - mean), std::abs(y - mean), std::abs(z - mean)});
  if (mean > 0 && std::isfinite(mean) && most <= kScaleRounding * mean) return mean;
  return Error{"a sphere-tree shape cannot be scaled by (" + exactly(x) + ", " + exactly(y) + ", " + exactly(z) +
               "): spheres stay spheres only under uniform scale, so scale the mesh and build its tree again"};
}

// All tolerances of the narrow phase are fractions of the size, in float whatever Bullet's precision is. Beyond these
// limits, squares of such lengths underflow or become infinite.
constexpr float kMinSize = 1e-21F, kMaxSize = 1e19F;

// In units of the shape's size. The unit in the last place of a larger margin is the whole mesh, so contacts at its
// surface are meaningless. Far beyond that, Bullet's solver gives touching bodies NaN.
constexpr float kMaxMargin = 1 / FLT_EPSILON;

Status checkMargin(btScalar margin, btScalar size) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%g", double(margin));
  const std::string which = std::string("a sphere-tree shape cannot have a margin of ") + text.data();
  if (!(margin >= 0) || !std::isfinite(margin)) return Error{which + ": give a length of 0 or more, in metres"};
  if (static_cast<float>(margin) <= kMaxMargin * static_cast<float>(size)) return {};
  std::snprintf(text.data(), text.size(), "%g", double(size));
  return Error{which + ": its mesh is " + text.data() + " m large, give at most 8e6 times that"};
}

Status checkSize(float diagonal, btScalar scale) {
  const float size = diagonal * static_cast<float>(scale);
  if (size >= kMinSize && size <= kMaxSize) return {};
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%g", double(size));
  return Error{std::string("a sphere-tree shape's mesh has a box with a diagonal of ") + text.data() +
               ": give a mesh and a scale that make it at least 1e-21 and at most 1e19"};
}

}  // namespace

Result<std::unique_ptr<SphereTreeShape>> SphereTreeShape::create(std::shared_ptr<const SphereTree> tree,
                                                                 BodyFrame frame, btScalar scale) {
  if (!tree) return Error{"a sphere-tree shape was asked for without a tree: load one with cairn::loadTree first"};
  if (const auto uniform = uniformScale(btVector3(scale, scale, scale)); !uniform) return uniform.error();
  if (Status status = checkSize(boxDiagonal(tree->vertices()), scale); !status) return status.error();
  return std::unique_ptr<SphereTreeShape>(new SphereTreeShape(std::move(tree), frame, scale));
}

SphereTreeShape::SphereTreeShape(std::shared_ptr<const SphereTree> tree, BodyFrame frame, btScalar scale)
    : tree_(std::move(tree)),
      extremes_(std::make_unique<ExtremePoints>(tree_->vertices())),
      regionBalls_(std::make_unique<RegionBalls>(*tree_)),
      unserved_(std::make_unique<UnservedWatch>()),
      frame_(frame) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  applyScale(scale);
}

SphereTreeShape::~SphereTreeShape() = default;

void SphereTreeShape::applyScale(btScalar scale) {
  scale_ = scale;
  localScaling_.setValue(scale, scale, scale);
  const MassProperties& mass = tree_->mass();
  const bool principal = frame_ == BodyFrame::principalAxes;
  const Mat3d rotation = principal ? transpose(mass.principalAxes) : Mat3d{};
  const Vec3d center = principal ? mass.centerOfMass : Vec3d{};
  const double s = double(scale);
  bodyFromMesh_ = btTransform(toBullet(rotation), toBullet(rotation * -center * s));
  bodyFromTree_ = btTransform(toBullet(rotation), toBullet(rotation * (tree_->origin() - center) * s));
  size_ = btScalar(extremes_->diagonal()) * scale;
  const Vec3 bodyOriginInTree(center - tree_->origin());
  angularMotionDisc_ = btScalar(extremes_->radiusAround(bodyOriginInTree)) * scale;
}

void SphereTreeShape::setCastTarget(CastTarget target) {
  leafBalls_ = target == CastTarget::spheres ? std::make_unique<const LeafBalls>(*tree_) : nullptr;
}

Status SphereTreeShape::setMaxContactError(btScalar fraction) {
  if (!(fraction >= 0))
    return Error{"contacts of a sphere-tree shape cannot err by at most " + exactly(fraction) +
                 " of its size: give 0 for the source mesh, or a fraction such as 0.01"};
  maxContactError_ = fraction;
  return {};
}

std::uint32_t SphereTreeShape::contactLevel(btScalar smallerSize) const {
  if (maxContactError_ == 0) return 0;
  const auto allowed = static_cast<float>(maxContactError_ * smallerSize / scale_);
  const float most = std::min(allowed, kMaxErrorOfThickness * tree_->surface().thickness);
  for (std::uint32_t level = 1; level <= tree_->levelMeshCount(); ++level)
    if (tree_->levelMesh(level).distance <= most) return level;
  return 0;
}

// All that may fail comes first.
Status SphereTreeShape::setVertices(std::span<const Vec3> vertices) {
  if (!refit_) {
    Result<TreeRefit> refit = TreeRefit::bind(tree_);
    if (!refit) return refit.error();
    refit_ = std::make_unique<TreeRefit>(std::move(refit).value());
  }
  Result<std::shared_ptr<const SphereTree>> moved = refit_->refitMesh(vertices);
  if (!moved) return moved.error();
  const float diagonal = boxDiagonal(moved.value()->vertices());
  if (Status status = checkSize(diagonal, scale_); !status) return status;
  if (Status status = checkMargin(getMargin(), btScalar(diagonal) * scale_); !status) return status;
  tree_ = std::move(moved).value();
  extremes_ = std::make_unique<const ExtremePoints>(ExtremePoints::all(tree_->vertices()));
  regionBalls_->follow(*tree_);
  if (leafBalls_) leafBalls_ = std::make_unique<const LeafBalls>(*tree_);
  applyScale(scale_);
  return {};
}

Status SphereTreeShape::setScale(const btVector3& scaling) {
  const Result<btScalar> scale = uniformScale(scaling);
  if (!scale) return scale.error();
  if (Status status = checkSize(extremes_->diagonal(), scale.value()); !status) return status;
  const btScalar size = btScalar(extremes_->diagonal()) * scale.value();
  if (Status status = checkMargin(getMargin(), size); !status) return status;
  applyScale(scale.value());
  return {};
}

void SphereTreeShape::setLocalScaling(const btVector3& scaling) {
  if (Status status = setScale(scaling); !status) logMessage(status.error().message.c_str());
}

void SphereTreeShape::setMargin(btScalar margin) {
  if (Status status = checkMargin(margin, size_); !status) {
    logMessage(status.error().message.c_str());
    return;
  }
  btConcaveShape::setMargin(margin);
}

void SphereTreeShape::getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const {
  unserved_->see(t, size_);
  const btTransform worldFromTree = t * bodyFromTree_;
  const btScalar grow = getMargin() + kSpeculativeFraction * size_;
  // Bullet also computes with the fourth floats.
  aabbMin.setW(0);
  aabbMax.setW(0);
  for (int axis = 0; axis < 3; ++axis) {
    const ExtremePoints::Interval interval = extremes_->along(toVec3(worldFromTree.getBasis()[axis]));
    aabbMin[axis] = worldFromTree.getOrigin()[axis] + btScalar(interval.lower) * scale_ - grow;
    aabbMax[axis] = worldFromTree.getOrigin()[axis] + btScalar(interval.upper) * scale_ + grow;
  }
}

void SphereTreeShape::getBoundingSphere(btVector3& center, btScalar& radius) const {
  const Sphere root = tree_->sphere(kRootNode);
  center = bodyFromTree_ * (toBullet(root.center) * scale_);
  radius = btScalar(root.radius) * scale_ + getMargin();
}

void SphereTreeShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const MassProperties& m = tree_->mass();
  const double factor = double(mass) * double(scale_) * double(scale_);
  if (frame_ == BodyFrame::principalAxes) {
    inertia = toBullet(m.principalMoments * factor);
    return;
  }
  const double toOriginSq = lengthSq(m.centerOfMass);
  Vec3d diagonal;
  for (int axis = 0; axis < 3; ++axis)
    diagonal[axis] = m.inertia(axis, axis) + toOriginSq - m.centerOfMass[axis] * m.centerOfMass[axis];
  inertia = toBullet(diagonal * factor);
}

std::size_t SphereTreeShape::memoryBytes() const {
  const std::size_t balls = leafBalls_ ? leafBalls_->memoryBytes() : 0;
  return sizeof *this + extremes_->memoryBytes() + regionBalls_->memoryBytes() + balls;
}

void SphereTreeShape::calculatePrincipalAxisTransform(btScalar mass, btTransform& principal, btVector3& inertia) const {
  const MassProperties& m = tree_->mass();
  const btTransform meshFromPrincipal(toBullet(m.principalAxes), toBullet(m.centerOfMass * double(scale_)));
  principal = bodyFrame() == BodyFrame::mesh ? meshFromPrincipal : btTransform::getIdentity();
  inertia = toBullet(m.principalMoments * (double(mass) * double(scale_) * double(scale_)));
}

const char* SphereTreeShape::getName() const {
  return kTreeName;
}

// Run-time type information would be asked of shapes that may have none.
const SphereTreeShape* asSphereTree(const btCollisionShape* shape) {
  if (shape->getShapeType() != FAST_CONCAVE_MESH_PROXYTYPE || shape->getName() != kTreeName) return nullptr;
  return static_cast<const SphereTreeShape*>(shape);
}

}  // namespace cairn::bullet

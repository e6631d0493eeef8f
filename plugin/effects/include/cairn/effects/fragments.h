// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/export.h"
#include "cairn/core/result.h"

class btCollisionShape;
class btCompoundShape;
class btRigidBody;

namespace cairn::effects {

/// The pieces that a kind of body can break into (made by `cairn fracture`): their trees, all in the mesh frame of the
/// whole, and the pairs of pieces that hang together. All bodies of the kind share it.
struct Fragments {
  std::vector<std::shared_ptr<const SphereTree>> pieces;  ///< none is null
  std::vector<std::array<std::uint32_t, 2>> bonds;        ///< two different pieces each
};

/// The pieces of the kind that one body consists of.
struct CAIRN_EFFECTS_EXPORT FragmentPart {
  std::shared_ptr<const Fragments> kind;  ///< not null
  std::vector<std::uint32_t> pieces;      ///< ascending
  btScalar scale = 1;                     ///< mesh unit to m
  btScalar density = 0;                   ///< kg/m^3
  btTransform bodyFromMesh =
      btTransform::getIdentity();  ///< places the whole's mesh frame (times scale) in the body's frame

  /// A whole body of the kind, whose shape is of the whole's own tree.
  static FragmentPart whole(std::shared_ptr<const Fragments> kind, const bullet::SphereTreeShape& shape,
                            btScalar density);
};

/// A body that is to take the place of part of a broken one: everything Bullet needs to make it. Its frame is that of
/// its principal axes.
struct FragmentBody {
  FragmentBody() = default;
  FragmentBody(FragmentBody&&) = default;
  FragmentBody& operator=(FragmentBody&&) = default;

  FragmentPart part;                                      ///< what it consists of
  std::vector<std::unique_ptr<btCollisionShape>> shapes;  ///< the last one is the body's; it refers to the others
  btScalar mass = 0, volume = 0;                          ///< kg, and m^3
  btVector3 inertia;                                      ///< kg m^2, about the body's axes
  btTransform pose = btTransform::getIdentity();          ///< world frame
  btVector3 linearVelocity, angularVelocity;              ///< m/s and rad/s, world frame

  /// The body's own shape. Valid as long as `shapes`.
  btCollisionShape& shape() const { return *shapes.back(); }
};

/// The piece of a body whose spheres come nearest to a place (world frame). Linear in the leaves.
CAIRN_EFFECTS_EXPORT
std::uint32_t nearestPiece(const btRigidBody& body, const FragmentPart& part, const btVector3& place);

/// The bodies left when one piece breaks off: the piece, then each group of the others that hangs together, in the
/// order of its first piece. They move as the matter of the old body did, so mass, momentum, angular momentum and
/// kinetic energy add up to the old body's. Precondition: `piece` is one of at least two of the body's.
/// Fails for what the shapes refuse.
CAIRN_EFFECTS_EXPORT
Result<std::vector<FragmentBody>> breakOff(const btRigidBody& body, const FragmentPart& part, std::uint32_t piece);

}  // namespace cairn::effects

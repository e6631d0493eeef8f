// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/core/result.h"
#include "cairn/soft/export.h"

class btCollisionDispatcher;

namespace cairn::soft {

class CreateNodeContacts;

/// Lets soft bodies (`btSoftBody`) meet sphere-trees with the mesh of the tree: each node is kept outside the nearest
/// face, or outside the face through which its way led in during the step. Bullet's own algorithm for concave shapes
/// takes each triangle as a prism 12 cm thick; this one takes its place.
///
///     btSoftBodyRigidBodyCollisionConfiguration configuration;
///     cairn::bullet::Dispatcher<> dispatcher(&configuration);
///     auto soft = cairn::soft::SoftContacts::install(dispatcher);  // keep it
///     if (!soft) return std::puts(soft.error().message.c_str()), 1;
///     btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
///
/// Works with any dispatcher, Cairn's or not, for trees that lie still, move, or follow a moving mesh
/// (`SphereTreeShape::setVertices`). Nodes stay as far off as the margins of soft body and tree together. Contacts are
/// answered in full in each step: neither budget nor statistics know of them.
///
/// Limits. Bullet makes a pair where the ends of nodes' ways come near, so a flat cloth that jumps over a thin tree in
/// one step does not meet it. Faces of a soft body are not tested between their nodes: a spike narrower than they are
/// passes. Bullet solves links after contacts, so that heavy ends pull a rope through thin shelves. Bodies of clusters
/// or deformables (`CL_RS`, `SDF_RD`) get Bullet's answer.
///
/// Cost: a node that cannot have come near since its last search costs nothing. Others cost a search of the nearest
/// triangle: two microseconds near a surface of a thousand triangles, ten of fifty thousand; deep inside a body ten
/// times as much.
class SoftContacts {
 public:
  /// Registers with the dispatcher. Fails where its collision configuration knows no soft bodies, and where somebody
  /// answers for soft bodies and concave shapes already. Pairs that touch by then keep Bullet's answer. Do not call
  /// while a step is under way.
  CAIRN_SOFT_EXPORT static Result<SoftContacts> install(btCollisionDispatcher& dispatcher);

  /// The other is empty afterwards: it may be destroyed or assigned to.
  CAIRN_SOFT_EXPORT SoftContacts(SoftContacts&&) noexcept;
  /// The same; gives back what this object held.
  CAIRN_SOFT_EXPORT SoftContacts& operator=(SoftContacts&&) noexcept;
  /// Gives pairs that are still to come back to Bullet. Must come before the dispatcher's end; worlds and bodies may
  /// live on.
  CAIRN_SOFT_EXPORT ~SoftContacts();

 private:
  explicit SoftContacts(std::unique_ptr<CreateNodeContacts> create);
  std::unique_ptr<CreateNodeContacts> create_;
};

}  // namespace cairn::soft

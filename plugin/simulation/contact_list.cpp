// SPDX-License-Identifier: Zlib
#include "simulation/contact_list.h"

#include <algorithm>

namespace cairn::simulation {

namespace {

using bullet::asSphereTree;
using bullet::ContactPart;
using bullet::SphereTreeShape;

bool isExact(const SphereTreeShape* tree, int part) {
  return tree == nullptr || part >= static_cast<int>(ContactPart::vertex);
}

// What a side's surface may be off where the contact is, m.
double errorOf(const SphereTreeShape* tree, int part, int index, btScalar smallerSize) {
  if (tree == nullptr) return 0;
  if (!isExact(tree, part))
    return index < 0 ? 0 : double(tree->tree().error(static_cast<NodeId>(index)) * tree->scale());
  const std::uint32_t level = tree->contactLevel(smallerSize);
  return level == 0 ? 0 : double(tree->tree().levelMesh(level).distance * tree->scale());
}

struct Sides {
  const btCollisionObject *a, *b;
  const SphereTreeShape *treeA, *treeB;

  explicit Sides(const btPersistentManifold& manifold)
      : a(manifold.getBody0()),
        b(manifold.getBody1()),
        treeA(asSphereTree(a->getCollisionShape())),
        treeB(asSphereTree(b->getCollisionShape())) {}
  btScalar smallerSize() const {
    if (treeA && treeB) return std::min(treeA->size(), treeB->size());
    return treeA ? treeA->size() : treeB ? treeB->size() : 0;
  }
};

Contact contactOf(const Sides& sides, const btManifoldPoint& point) {
  const btScalar size = sides.smallerSize();
  Contact contact;
  contact.point = point.getPositionWorldOnB();
  contact.normal = point.m_normalWorldOnB;
  contact.depth = float(-point.getDistance());
  contact.error = float(errorOf(sides.treeA, point.m_partId0, point.m_index0, size) +
                        errorOf(sides.treeB, point.m_partId1, point.m_index1, size));
  contact.impulse = float(point.m_appliedImpulse);
  contact.a = sides.a->getUserIndex();
  contact.b = sides.b->getUserIndex();
  contact.isExact = isExact(sides.treeA, point.m_partId0) && isExact(sides.treeB, point.m_partId1);
  return contact;
}

}  // namespace

void listContacts(const Simulation& simulation, std::vector<Contact>& contacts) {
  // Bullet's reader is not const.
  auto& manifolds = const_cast<bullet::Dispatcher<>&>(simulation.narrowPhase());
  contacts.clear();
  for (int i = 0; i < manifolds.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds.getManifoldByIndexInternal(i);
    const Sides sides(manifold);
    for (int j = 0; j < manifold.getNumContacts(); ++j)
      contacts.push_back(contactOf(sides, manifold.getContactPoint(j)));
  }
}

}  // namespace cairn::simulation

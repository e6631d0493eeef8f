// SPDX-License-Identifier: Zlib
#include "contact_list.h"

#include <algorithm>

namespace cairn::wasm {

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

void append(const Sides& sides, const btManifoldPoint& point, std::vector<float>& list) {
  const btVector3 &at = point.getPositionWorldOnB(), &normal = point.m_normalWorldOnB;
  const btScalar size = sides.smallerSize();
  const double error = errorOf(sides.treeA, point.m_partId0, point.m_index0, size) +
                       errorOf(sides.treeB, point.m_partId1, point.m_index1, size);
  const bool exact = isExact(sides.treeA, point.m_partId0) && isExact(sides.treeB, point.m_partId1);
  for (int i = 0; i < 3; ++i) list.push_back(at[i]);
  for (int i = 0; i < 3; ++i) list.push_back(normal[i]);
  list.insert(list.end(), {float(-point.getDistance()), float(error), float(sides.a->getUserIndex()),
                           float(sides.b->getUserIndex()), float(point.m_appliedImpulse), exact ? 1.0F : 0.0F});
}

}  // namespace

void listContacts(const Simulation& simulation, std::vector<float>& list) {
  auto& manifolds = const_cast<btCollisionDispatcher&>(simulation.manifolds());  // Bullet's reader is not const
  for (int i = 0; i < manifolds.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds.getManifoldByIndexInternal(i);
    const Sides sides(manifold);
    for (int j = 0; j < manifold.getNumContacts(); ++j) append(sides, manifold.getContactPoint(j), list);
  }
}

}  // namespace cairn::wasm

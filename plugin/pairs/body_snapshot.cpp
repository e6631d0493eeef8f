// SPDX-License-Identifier: Zlib
#include "pairs/body_snapshot.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

namespace cairn::bullet {

bool BodySnapshot::take(const btCollisionObjectWrapper& wrapper) {
  std::array<const btCollisionObjectWrapper*, kMaxNesting> chain{};
  depth_ = 0;
  for (const btCollisionObjectWrapper* w = &wrapper; w; w = w->m_parent) {
    if (depth_ == kMaxNesting) return false;
    chain[depth_++] = w;
  }
  const btCollisionObjectWrapper* parent = nullptr;
  for (std::size_t i = 0; i < depth_; ++i) {
    const btCollisionObjectWrapper& from = *chain[depth_ - 1 - i];
    Level& level = levels_[i];
    level.transform = from.getWorldTransform();
    level.wrapper.emplace(parent, from.getCollisionShape(), from.getCollisionObject(), level.transform, from.m_partId,
                          from.m_index);
    parent = &*level.wrapper;
  }
  return true;
}

namespace {

// Null when the wrapper's shape is no longer the child it was.
const btCompoundShape* parentOf(const btCollisionObjectWrapper& child, const btCollisionShape& parent) {
  if (!parent.isCompound()) return nullptr;
  const auto& compound = static_cast<const btCompoundShape&>(parent);
  const bool isChild = child.m_index >= 0 && child.m_index < compound.getNumChildShapes() &&
                       compound.getChildShape(child.m_index) == child.getCollisionShape();
  return isChild ? &compound : nullptr;
}

}  // namespace

bool BodySnapshot::follow() {
  const btCollisionObject& object = *levels_[0].wrapper->getCollisionObject();
  if (object.getCollisionShape() != levels_[0].wrapper->getCollisionShape()) return false;
  levels_[0].transform = object.getWorldTransform();
  for (std::size_t i = 1; i < depth_; ++i) {
    const btCollisionObjectWrapper& child = *levels_[i].wrapper;
    const btCompoundShape* const compound = parentOf(child, *levels_[i - 1].wrapper->getCollisionShape());
    if (!compound) return false;
    levels_[i].transform = levels_[i - 1].transform * compound->getChildTransform(child.m_index);
  }
  return true;
}

bool BodySnapshot::hasMoved() const {
  return !(levels_[0].transform == levels_[0].wrapper->getCollisionObject()->getWorldTransform());
}

bool BodySnapshot::isOf(const btCollisionObjectWrapper& wrapper) const {
  const btCollisionObjectWrapper& own = this->wrapper();
  return own.getCollisionObject() == wrapper.getCollisionObject() &&
         own.getCollisionShape() == wrapper.getCollisionShape() &&
         own.getWorldTransform() == wrapper.getWorldTransform();
}

std::uint32_t childPath(const btCollisionObjectWrapper& wrapper) {
  std::uint32_t path = 0;
  for (const btCollisionObjectWrapper* w = &wrapper; w->m_parent; w = w->m_parent)
    path = path * 1000003U + static_cast<std::uint32_t>(w->m_index) + 1;
  return path;
}

}  // namespace cairn::bullet

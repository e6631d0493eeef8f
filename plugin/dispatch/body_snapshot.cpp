// SPDX-License-Identifier: Zlib
#include "dispatch/body_snapshot.h"

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

std::uint32_t childPath(const btCollisionObjectWrapper& wrapper) {
  std::uint32_t path = 0;
  for (const btCollisionObjectWrapper* w = &wrapper; w->m_parent; w = w->m_parent)
    path = path * 1000003U + static_cast<std::uint32_t>(w->m_index) + 1;
  return path;
}

}  // namespace cairn::bullet

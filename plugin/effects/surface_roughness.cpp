// SPDX-License-Identifier: Zlib
#include "cairn/effects/surface_roughness.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include <cmath>
#include <optional>

#include "cairn/core/mix_bits.h"

namespace cairn::effects {
namespace {

// In [0, 1).
btScalar fraction(std::uint64_t bits) {
  return btScalar(static_cast<double>(bits >> 11) * 0x1p-53);
}

// The body that moves and the material of what does not.
struct Meeting {
  const Body& body;
  MaterialId ground;
};

std::optional<Meeting> meetingOf(const Contact& contact) {
  const Side &a = contact.sides[0], &b = contact.sides[1];
  if (a.body != nullptr && b.body == nullptr) return Meeting{*a.body, b.material};
  if (b.body != nullptr && a.body == nullptr) return Meeting{*b.body, a.material};
  return std::nullopt;
}

}  // namespace

btVector3 SurfaceRoughness::tilted(const btVector3& normal, btScalar maxTilt, std::uint32_t bodyId,
                                   std::uint64_t step) const {
  const std::uint64_t key = mixBits(mixBits(mixBits(seed_ + 1) + bodyId + 1) + step + 1);
  const btScalar angle = maxTilt * fraction(mixBits(key)), turn = SIMD_2_PI * fraction(mixBits(key + 1));
  btVector3 across, along;
  btPlaneSpace1(normal, across, along);
  const btVector3 direction = across * btCos(turn) + along * btSin(turn);
  return (normal * btCos(angle) + direction * btSin(angle)).normalized();
}

bool SurfaceRoughness::tilt(Contact& contact, const Step& step) {
  const std::optional<Meeting> meeting = meetingOf(contact);
  if (!meeting || meeting->ground >= heights_.size()) return false;
  const btScalar radius = meeting->body.radius, height = heights_[meeting->ground];
  if (radius <= 0 || height <= 0) return false;
  const btVector3 before = contact.point->m_normalWorldOnB;
  const btVector3 after = tilted(before, btAtan(height / radius), meeting->body.id, step.number);
  const btScalar closing = -contact.relativeVelocity.dot(after);
  if (closing <= 0) return false;
  changed_.push_back({contact.point, before});
  contact.point->m_normalWorldOnB = after;
  contact.closingSpeed = closing;
  return true;
}

std::uint32_t SurfaceRoughness::changeContacts(std::span<Contact> contacts, const Step& step) {
  changed_.clear();
  for (Contact& contact : contacts)
    if (contact.impact >= 0) tilt(contact, step);
  return static_cast<std::uint32_t>(changed_.size());
}

void SurfaceRoughness::restoreContacts(std::span<Contact> /*contacts*/) {
  for (const Changed& changed : changed_) changed.point->m_normalWorldOnB = changed.normal;
}

}  // namespace cairn::effects

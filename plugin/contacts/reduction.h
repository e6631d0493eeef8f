// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Points that a Bullet manifold holds.
inline constexpr int kMaxPoints = 4;

/// Chooses the contacts that represent a cluster, moves them to its front in order and returns them. It takes the
/// deepest, then the farthest from it, then those that span the largest area.
///
/// Contacts whose id is among `held` get a bonus, so that the choice does not flicker; their `isInManifold` is set. No
/// two chosen points are closer than `separation` (world length), because Bullet would merge them. `maxSeparation` is
/// the speculative distance and scales the bonus in depth. Precondition: `cluster` is sorted deepest first. Cost:
/// linear in the cluster.
std::span<Contact> chooseContacts(std::span<Contact> cluster, std::span<const ContactId> held, float separation,
                                  float maxSeparation);

}  // namespace cairn::bullet

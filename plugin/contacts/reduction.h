// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Points a Bullet manifold holds.
inline constexpr int kMaxPoints = 4;

/// Chooses the contacts that stand for a cluster, moves them to its front in this order and returns them: the deepest,
/// the farthest from it, then those that span the largest area. Contacts whose id is among `held` get a bonus, so that
/// the choice does not flicker (their `isInManifold` is set); no two chosen points lie closer than `separation`,
/// because Bullet would take them for one. `maxSeparation` is the speculative distance, the scale of the depth bonus.
/// Precondition: `cluster` sorted deepest first. Linear in the cluster.
std::span<Contact> chooseContacts(std::span<Contact> cluster, std::span<const ContactId> held, float separation,
                                  float maxSeparation);

}  // namespace cairn::bullet

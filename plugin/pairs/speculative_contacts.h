// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Drops present contacts that a speculative contact overrules. A dropped contact's separation is set to
/// `maxSeparation` (world length).
void dropOverruled(std::span<const Contact> speculative, float maxSeparation, ClusteredContacts& contacts);

}  // namespace cairn::bullet

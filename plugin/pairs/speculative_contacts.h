// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Of contacts of now, drops those that a contact ahead overrules. `maxSeparation` (world length): what is dropped is
/// put as far apart.
void dropOverruled(std::span<const Contact> speculative, float maxSeparation, ClusteredContacts& contacts);

}  // namespace cairn::bullet

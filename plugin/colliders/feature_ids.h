// SPDX-License-Identifier: Zlib
#pragma once

#include "contacts/contact.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// Which features of two sphere-trees' meshes touch: see `ContactPart`; -1 for what has none.
ContactId featureIdsOf(const FeatureContact& contact);

/// What the kernel found, as a pair's contact of that id.
Contact contactOf(const FeatureContact& found, const ContactId& id);

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include "contacts/contact.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// The contact ids of two touching features of sphere-trees' meshes: see `ContactPart`; -1 where there is no feature.
ContactId featureIdsOf(const FeatureContact& contact);

/// Converts a contact of the kernel to a contact of the pair with this id.
Contact contactOf(const FeatureContact& found, const ContactId& id);

}  // namespace cairn::bullet

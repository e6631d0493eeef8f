// SPDX-License-Identifier: Zlib
#pragma once

class btCollisionObjectWrapper;

namespace cairn::bullet {

/// Whether the spheres around two whole trees are certainly too far apart for any contact, the speculative distance
/// included: then nothing else has to be looked at. False as well when either shape is no sphere-tree.
bool areRootsApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);

}  // namespace cairn::bullet

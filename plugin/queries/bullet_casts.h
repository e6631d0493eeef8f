// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace cairn::bullet {

/// The callback as one of Bullet's rays or sweeps, which looks for the nearest hit, or null. What does something else
/// with its triangles than these is none. Decided without run-time type information, see `VirtualTable`.
btTriangleRaycastCallback* asRay(btTriangleCallback& callback);
btTriangleConvexcastCallback* asSweep(btTriangleCallback& callback);

}  // namespace cairn::bullet

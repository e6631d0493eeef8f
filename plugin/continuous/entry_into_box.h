// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The fraction (0 to 1) of its displacement at which a point enters the box [lower, upper]; empty if it does not. Any
/// one frame and unit; constant time.
std::optional<float> entryIntoBox(const Vec3& lower, const Vec3& upper, const Vec3& point, const Vec3& displacement);

}  // namespace cairn::bullet

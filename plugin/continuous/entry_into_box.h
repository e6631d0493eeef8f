// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// At which part of its way (0 to 1) a point enters the box [lower, upper]; nothing if it does not.
std::optional<float> entryIntoBox(const Vec3& lower, const Vec3& upper, const Vec3& point, const Vec3& displacement);

}  // namespace cairn::bullet

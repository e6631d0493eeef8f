// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Beyond this the squares of an overlap test would leave float's range, and infinity overlaps everything.
inline constexpr float kMaxLength = 1e15F;

/// Everything `SphereTree` relies on; the error names the first offending element.
Status checkTree(const SphereTreeData& data);

}  // namespace cairn

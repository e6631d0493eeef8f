// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Everything `SphereTree` relies on; the error names the first offending element.
Status checkTree(const SphereTreeData& data);

}  // namespace cairn

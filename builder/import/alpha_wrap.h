// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// CGAL's alpha wrap of a surface, unproved and in double; `alpha` and `offset` in mesh unit. Fails when it would need
/// more than a million vertices, when CGAL gives up, and with `kCancelled`.
Result<TriangleMesh> alphaWrap(const TriangleMesh& surface, double alpha, double offset,
                               const ProgressCallback& progress);

}  // namespace cairn::builder

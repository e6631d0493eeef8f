// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Returns CGAL's alpha wrap of a surface, unproved and in double precision. `alpha` and `offset` are in mesh units.
/// Fails for a wrap of more than a million vertices, when CGAL fails, and with `kCancelled`.
Result<TriangleMesh> alphaWrap(const TriangleMesh& surface, double alpha, double offset,
                               const ProgressCallback& progress);

}  // namespace cairn::builder

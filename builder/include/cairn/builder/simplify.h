// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// The mesh with at most `triangles` triangles, by edge collapses of least quadric error (Garland and Heckbert 1997),
/// still closed and checked by `checkMesh`. For scans that are far finer than a game wants to carry; certified errors
/// then refer to the simplified mesh. Fails when the collapses cannot get that far, when the result intersects itself,
/// and with `kCancelled`.
/// Precondition: `checkMesh(mesh)`. O(n log n), single thread.
Result<TriangleMesh> simplify(const TriangleMesh& mesh, std::uint32_t triangles, const ProgressCallback& progress = {});

/// The mesh as the text of an OBJ file, with the digits to give back the same doubles.
std::string objText(const TriangleMesh& mesh);

}  // namespace cairn::builder

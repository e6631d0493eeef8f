// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Reduces a mesh to at most `triangles` triangles by edge collapses of least quadric error (Garland and Heckbert
/// 1997). The result is closed and has passed `checkMesh`. It serves for scans that are finer than an application
/// needs. Certified errors then refer to the simplified mesh. Fails when the collapses cannot reach the target, when
/// the result intersects itself, and with `kCancelled`. Precondition: `checkMesh(mesh)`. O(n log n), single thread.
///
///     TriangleMesh coarse = simplify(importMesh("scan.ply").value(), 20'000).value();
Result<TriangleMesh> simplify(const TriangleMesh& mesh, std::uint32_t triangles, const ProgressCallback& progress = {});

/// Returns the mesh as the text of an OBJ file, with enough digits to give back the same doubles. Linear.
std::string objText(const TriangleMesh& mesh);

}  // namespace cairn::builder

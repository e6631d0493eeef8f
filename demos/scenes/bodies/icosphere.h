// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::scenes {

/// Returns an icosahedron on the unit sphere, with each triangle split in four `subdivisions` times: 20 * 4^n
/// triangles, convex. The mesh has no name.
builder::TriangleMesh icosphere(std::uint32_t subdivisions);

}  // namespace cairn::scenes

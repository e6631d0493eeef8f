// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the mesh without unused vertices, numbered by first use; without a name. Linear.
TriangleMesh renumbered(const TriangleMesh& mesh);

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The same triangles with only the vertices they use, numbered by first use; nameless. Linear.
TriangleMesh renumbered(const TriangleMesh& mesh);

}  // namespace cairn::builder

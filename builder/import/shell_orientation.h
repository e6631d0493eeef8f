// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "surface/edges.h"

namespace cairn::builder {

/// A shell that faces the wrong way: the solid would lie on both sides of it, or on neither.
struct MisplacedShell {
  std::uint32_t triangle = 0;  ///< its first triangle
  bool facesOutward = false;   ///< present direction; the shell should be reversed or removed
};

/// Returns the first shell that does not fit the others. A shell that faces outward must lie outside the solid of all
/// others. A shell that faces inward (a cavity) must lie inside it. Precondition: every shell is closed and oriented,
/// and no two meet. Cost: O(triangles) for each shell that might contain it.
std::optional<MisplacedShell> findMisplacedShell(const TriangleMesh& mesh, const Shells& shells);

}  // namespace cairn::builder

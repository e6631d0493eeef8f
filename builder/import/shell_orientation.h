// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "surface/edges.h"

namespace cairn::builder {

/// A shell that faces the wrong way: the solid would lie on both sides of it, or on neither.
struct MisplacedShell {
  std::uint32_t triangle = 0;  ///< its first
  bool facesOutward = false;   ///< as it is; so it should be turned, or taken out
};

/// The first shell of several that does not fit: one facing outward must lie outside the solid of all others, one
/// facing inward (a cavity) inside it. Precondition: every shell is closed and oriented, none meet. O(triangles) a
/// shell it might lie in.
std::optional<MisplacedShell> findMisplacedShell(const TriangleMesh& mesh, const Shells& shells);

}  // namespace cairn::builder

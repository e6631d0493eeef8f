// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// One line `level x y z r parent` per sphere, breadth-first; mesh frame and unit; `parent` is the 0-based line of the
/// parent, -1 for the root. Positions and radii have the digits to give back the same doubles.
std::string spheresText(const SphereTree& tree);

/// The format of Bradshaw's sphere-tree toolkit: a first line `levels degree`, then `x y z r importance` for every slot
/// of the complete tree, children of slot n at n * degree + 1 onwards, unused slots with a negative radius. Mesh frame
/// and unit. Fails when the complete tree would have more than `kMaxSphSlots` slots.
Result<std::string> sphText(const SphereTree& tree);
/// Slots that `sphText` writes at most.
inline constexpr std::uint64_t kMaxSphSlots = 1U << 24;

/// Wavefront OBJ, as text, or binary glTF.
enum class SurfaceFormat : std::uint8_t { obj, glb };

/// The spheres of `levelCut(level)` as triangulated icospheres (whose corners lie on the spheres), for looking at; mesh
/// frame and unit, single precision. Written completely or not at all. Fails when the tree has no such level or the
/// file cannot be written.
Status writeSphereSurfaces(const SphereTree& tree, std::uint32_t level, SurfaceFormat format,
                           const std::filesystem::path& path);

}  // namespace cairn::builder

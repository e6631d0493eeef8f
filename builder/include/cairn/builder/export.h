// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cairn/builder/ball.h"

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Returns one line `level x y z r parent` per sphere, breadth-first, in mesh frame and unit. `parent` is the 0-based
/// line of the parent, -1 for the root. Here and below, nodes with two spheres give the one that answers. Positions and
/// radii have enough digits to give back the same doubles. Linear.
///
///     writeFile("bunny.spheres", spheresText(tree));
std::string spheresText(const SphereTree& tree);

/// Returns the tree in the format of Bradshaw's sphere-tree toolkit. The first line is `levels degree`. One line `x y z
/// r importance` follows for every slot of the complete tree. The children of slot n start at slot n * degree + 1;
/// unused slots have a negative radius. Mesh frame and unit. Fails when the complete tree would have more than
/// `kMaxSphSlots` slots.
Result<std::string> sphText(const SphereTree& tree);
/// Largest number of slots that `sphText` writes.
inline constexpr std::uint64_t kMaxSphSlots = 1U << 24;

/// The spheres of `levelCut(level)`, in mesh frame and unit; depths are unknown (0). Fails when the tree has no such
/// level.
Result<std::vector<Ball>> ballsOfLevel(const SphereTree& tree, std::uint32_t level);

/// Wavefront OBJ (text) or binary glTF.
enum class SurfaceFormat : std::uint8_t { obj, glb };

/// Writes the spheres of `levelCut(level)` as triangulated icospheres for display. The icospheres' corners lie on the
/// spheres. Mesh frame and unit, single precision. The file is written completely or not at all. Fails when the tree
/// has no such level or the file cannot be written.
Status writeSphereSurfaces(const SphereTree& tree, std::uint32_t level, SurfaceFormat format,
                           const std::filesystem::path& path);
/// Writes any spheres as icospheres, like the function above. Precondition: `balls` is not empty.
Status writeSphereSurfaces(std::span<const Ball> balls, SurfaceFormat format, const std::filesystem::path& path);

}  // namespace cairn::builder

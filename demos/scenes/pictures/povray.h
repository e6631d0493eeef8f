// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// Pieces of a POV-Ray 3.7 scene as text, right-handed with z up (the camera mirrors POV-Ray's left-handed x).

/// `<x,y,z>`.
std::string povrayVector(const Vec3d& v);

/// `#declare name = mesh2 {...}`: smooth-shaded, but sharp where faces meet at more than 55 degrees.
std::string povrayMesh(const std::string& name, std::span<const Vec3d> vertices,
                       std::span<const std::array<std::uint32_t, 3>> triangles);

struct PictureSize {
  std::uint32_t width = 1600, height = 800;
};

/// Returns the size of the same picture at another width.
PictureSize scaledTo(const PictureSize& size, std::uint32_t width);

/// Renders a scene with the program povray (Debian package of that name), without a window, to a PNG. The file is
/// written completely or not at all. Fails with one sentence if povray is missing or refuses the scene. Blocks until it
/// is done.
Status renderWithPovray(const std::string& scene, const PictureSize& size, const std::filesystem::path& png);

}  // namespace cairn::scenes

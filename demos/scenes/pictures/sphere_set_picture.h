// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"
#include "scenes/pictures/sphere_parts.h"

namespace cairn::scenes {

/// Balls that stand for a whole solid, and what they are called.
struct SphereSet {
  std::string heading, line;
  std::vector<builder::Ball> balls;
};

/// A contact sheet: sets in rows, all rows of one length. Precondition: at least one set in each row.
using SphereSheet = std::vector<std::vector<SphereSet>>;

/// Of a picture as wide as this many pixels.
PictureSize sphereSetPictureSize(const SphereSheet& sheet, std::uint32_t width);

/// A POV-Ray scene of the sheet: each ball coloured by how far it can stand off the solid (`Ball::standOff`), with a
/// colour scale.
std::string sphereSetPicture(const builder::TriangleMesh& mesh, const SphereSheet& sheet, const MeshView& view);

}  // namespace cairn::scenes

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"
#include "scenes/pictures/sphere_parts.h"

namespace cairn::scenes {

/// Balls that represent a whole solid, and their title.
struct SphereSet {
  std::string heading, line;
  std::vector<builder::Ball> balls;
};

/// A contact sheet: sets in rows, all rows of one length. Precondition: at least one set in each row.
using SphereSheet = std::vector<std::vector<SphereSet>>;

/// Returns the size of a picture of the sheet with this width in pixels.
PictureSize sphereSetPictureSize(const SphereSheet& sheet, std::uint32_t width);

/// Returns a POV-Ray scene of the sheet. Each ball is coloured by its largest possible distance from the solid
/// (`Ball::standOff`), with a colour scale.
std::string sphereSetPicture(const builder::TriangleMesh& mesh, const SphereSheet& sheet, const MeshView& view);

}  // namespace cairn::scenes

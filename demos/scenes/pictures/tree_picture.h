// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/core/sphere_tree.h"
#include "scenes/pictures/sphere_parts.h"

namespace cairn::scenes {

inline constexpr PictureSize kTreePictureSize{1800, 620};

/// Returns a POV-Ray scene of a tree for `kTreePictureSize`: the mesh, then the spheres of levels 0 to 3 side by side.
/// A shallower tree shows fewer levels. Each sphere is coloured by its certified error, with a colour scale.
std::string treePicture(const SphereTree& tree, const MeshView& view);

}  // namespace cairn::scenes

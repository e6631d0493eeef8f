// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "cairn/core/sphere_tree.h"
#include "scenes/pictures/povray.h"

namespace cairn::scenes {

/// Which mesh axis points up in a picture.
enum class UpAxis : std::uint8_t { y, z };

struct TreePictureOptions {
  UpAxis up = UpAxis::y;
  double turnDegrees = 30;  ///< of the mesh about its up axis
};

inline constexpr PictureSize kTreePictureSize{1800, 620};

/// A POV-Ray scene of a tree for `kTreePictureSize`: the mesh, then the spheres of levels 0 to 3 (fewer if the tree is
/// shallower), side by side, each sphere coloured by its certified error, with a colour scale.
std::string treePicture(const SphereTree& tree, const TreePictureOptions& options);

}  // namespace cairn::scenes

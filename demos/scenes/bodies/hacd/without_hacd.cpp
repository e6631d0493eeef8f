// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/convex_parts.h"

namespace cairn::scenes {

Result<std::vector<std::vector<Vec3d>>> convexParts(std::span<const Vec3d>,
                                                    std::span<const std::array<std::uint32_t, 3>>) {
  return Error{
      "this build has no HACD: install libbullet-extras-dev and configure again, or leave out the shape compound"};
}

}  // namespace cairn::scenes

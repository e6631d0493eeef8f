// SPDX-License-Identifier: Zlib
// Limits that decide which triangles of a leaf belong to the face that a body stands on.
#pragma once

#include <cstddef>

namespace cairn::bullet {

// Triangles of a leaf that are looked at. A leaf may list any number of them, and no budget covers them.
constexpr std::size_t kMaxTriangles = 64;
// Cosine of 10 degrees. A triangle may lean by this much against the given normal, and planes within it count as one.
constexpr float kSameFaceCosine = 0.984807753F;
// Fraction of a leaf's radius, or of a triangle's side. A corner may miss the triangle that it stands on by this much,
// which covers rounding alone.
constexpr float kSeam = 1e-4F;

}  // namespace cairn::bullet

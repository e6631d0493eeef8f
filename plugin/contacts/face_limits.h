// SPDX-License-Identifier: Zlib
// What says which triangles of a leaf are of the face that something stands on.
#pragma once

#include <cstddef>

namespace cairn::bullet {

// Triangles that a leaf may be asked about: their number has no bound, and no budget covers them.
constexpr std::size_t kMaxTriangles = 64;
// Cosine of the 10 degrees by which a triangle may lean against the normal looked along, and within which planes are
// one.
constexpr float kSameFaceCosine = 0.984807753F;
// Fraction of a leaf's radius, or of a triangle's side, by which a corner may miss a triangle it stands on: no more
// than rounding does.
constexpr float kSeam = 1e-4F;

}  // namespace cairn::bullet

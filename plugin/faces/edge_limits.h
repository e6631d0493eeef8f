// SPDX-License-Identifier: Zlib
// What tells that a pair of edges separates two bodies, and not a face of one.
#pragma once

namespace cairn::bullet {

// Sine of the angle below which two edges are parallel: nothing is across them.
constexpr float kParallelEdges = 0.1F;
// A face is preferred to a pair of edges that separates better by less than this fraction of the size: the cross
// product of two edges that are nearly parallel says nothing.
constexpr float kFaceFraction = 0.001F;

}  // namespace cairn::bullet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/edges.h"

namespace cairn::builder {

/// True when triangles cancel at every edge: as many pass it one way as the other. Then every point is inside or
/// outside, however many triangles an edge has.
bool isBalanced(const TriangleMesh& mesh);

/// Returns the bodies of a balanced mesh. Triangles of an edge belong together when nothing but solid lies between
/// them, so cubes that share an edge or a face are two bodies. Numbered by their first triangles.
Shells bodiesOf(const TriangleMesh& mesh);

/// A body as a mesh of its own.
struct Body {
  TriangleMesh mesh;
  std::vector<std::uint32_t> triangles;  ///< for each of its triangles: its number in the whole
  Bounds bounds;
  bool facesOutward = true;
};
std::vector<Body> separated(const TriangleMesh& mesh, const Shells& bodies);

/// Gives the whole the body's vertices in place of those it had. Vertices that nothing uses stay.
void putBack(const Body& body, TriangleMesh& whole);

/// Turns bodies of a balanced mesh to face away from their solids. A body within another one that it does not meet
/// stays a hollow if both face opposite ways; all other bodies face outward. Returns for each body the one that it is
/// a hollow of, itself for the others. Cost: one winding number and one search for crossings
/// for each pair of a body and another one in its box, and only when a body faces inward.
std::vector<std::uint32_t> faceOutward(TriangleMesh& mesh, const Shells& bodies);

}  // namespace cairn::builder

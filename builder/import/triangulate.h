// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "import/polygon_soup.h"

namespace cairn::builder {

/// Cuts every polygon into triangles between its own corners. They face like the polygon and keep the file's order.
/// Neighbours keep their common edges, so a closed surface stays closed. A corner in the middle of a straight side is
/// also a corner of triangles.
///
/// A quadrangle is cut from its first corner to its third, as assimp does, so that formats agree. The other diagonal is
/// used if the first folds the quadrangle over or leaves a triangle without area. A polygon with more corners that is
/// simple near some plane gets the constrained Delaunay triangulation there, by exact predicates. Other polygons (with
/// a bridge to a hole, for example) get the triangulation with the least angles between neighbours.
///
/// Triangles fan out from the first corner where CGAL finds no triangulation or more than a hundred corners would be
/// searched. `checkMesh` reports triangles that then fold over. Never fails. Precondition: corners are in range,
/// polygons have three or more. Linear except for polygons of more than four corners.
TriangleSoup triangulated(const PolygonSoup& polygons);

}  // namespace cairn::builder

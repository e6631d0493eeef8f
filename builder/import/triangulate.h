// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "import/polygon_soup.h"

namespace cairn::builder {

/// Every polygon cut into triangles between its own corners, which face the way it does and come in the order of the
/// file. Neighbours keep their common edges, so a closed surface stays closed: a corner in the middle of a straight
/// side is a corner of triangles too. A quadrangle is cut from its first corner to its third (as assimp does, so that
/// formats agree) unless that folds it over or leaves a triangle without area. With more corners, those that are simple
/// near some plane get the constrained Delaunay triangulation there, by exact predicates; others (a bridge to a hole in
/// them, say) the triangulation with the least angles between neighbours. Where CGAL finds none, or there are more than
/// a hundred corners to search through, triangles fan out from the first corner; `checkMesh` names what then folds
/// over. Never fails. Precondition: corners are in range, polygons have three or more. Linear but for such polygons.
TriangleSoup triangulated(const PolygonSoup& polygons);

}  // namespace cairn::builder

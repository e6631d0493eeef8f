// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/repair.h"

#include <fmt/format.h>

#include <utility>

#include "cairn/builder/import.h"
#include "import/bodies.h"
#include "import/border.h"
#include "import/close_surface.h"
#include "import/settle.h"
#include "import/stitch.h"
#include "import/unite.h"

namespace cairn::builder {

bool RepairCounts::any() const {
  return duplicateTriangles + joinedVertices + splitTriangles + collapsedTriangles + filledHoles + turnedTriangles +
             movedTriangles + closedGaps + unitedBodies + enclosedBodies + cutTriangles + foldedTriangles +
             beadedEdges >
         0;
}

std::string RepairCounts::text() const {
  std::string text;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}", count, count == 1 ? one : many);
  };
  add(duplicateTriangles, "duplicate triangle left out", "duplicate triangles left out");
  add(joinedVertices, "border vertex joined", "border vertices joined");
  add(splitTriangles, "triangle split at a border vertex", "triangles split at border vertices");
  add(collapsedTriangles, "collapsed triangle left out", "collapsed triangles left out");
  add(filledHoles, "hole filled", "holes filled");
  add(addedTriangles, "triangle added", "triangles added");
  add(turnedTriangles, "triangle turned", "triangles turned");
  add(movedTriangles, "triangle moved outward where surfaces nearly coincided",
      "triangles moved outward where surfaces nearly coincided");
  add(closedGaps, "gap between bodies closed", "gaps between bodies closed");
  add(unitedBodies, "body united", "bodies united");
  add(enclosedBodies, "body inside others left out", "bodies inside others left out");
  add(cutTriangles, "triangle cut where surfaces met", "triangles cut where surfaces met");
  add(foldedTriangles, "part of a triangle around a fold that wound backwards and is solid now",
      "parts of triangles around folds that wound backwards and are solid now");
  add(beadedEdges, "edge thickened where solids only touched", "edges thickened where solids only touched");
  return text.empty() ? "nothing" : text;
}

namespace {

/// Closes cracks: those of rounding first, so that wider ones are not taken for more than they are.
void stitch(TriangleMesh& mesh, double weld, RepairCounts& found) {
  const double diagonal = boundsOf(mesh).diagonal();
  dropDuplicates(mesh, found);
  for (const double fraction : {kStitchTolerance, weld}) {
    if (fraction < kStitchTolerance || borderEdges(mesh).empty()) return;
    joinBorders(mesh, fraction * diagonal, found);
    dropDuplicates(mesh, found);
    splitAtBorderVertices(mesh, fraction * diagonal, found);
  }
}

/// Without the mesh's name in errors.
Result<TriangleMesh> closedAndUnited(const TriangleMesh& stitched, double weld, RepairCounts& found) {
  Result<TriangleMesh> closed = closeSurface(stitched, found);
  if (!closed) return closed;
  TriangleMesh mesh = settled(closed.value());
  if (!isBalanced(mesh)) return mesh;  // `checkMesh` will name the edge
  return unite(mesh, weld * boundsOf(mesh).diagonal(), found);
}

}  // namespace

Result<TriangleMesh> repair(const TriangleMesh& surface, RepairCounts* counts, const RepairOptions& options) {
  if (!(options.weld >= 0 && options.weld <= kMaxWeld))
    return Error{fmt::format("the weld is {} of the diagonal; choose 0 to {}", options.weld, kMaxWeld)};
  RepairCounts found;
  TriangleMesh stitched = settled(surface);
  if (stitched.triangles.empty())
    return Error{
        fmt::format("{}: no triangle is left when coordinates are rounded to single precision, as those of a "
                    "repaired mesh are; move it nearer to its origin",
                    surface.name)};
  stitch(stitched, options.weld, found);
  // Settling drops vertices without triangles.
  Result<TriangleMesh> closed = closedAndUnited(settled(stitched), options.weld, found);
  if (counts != nullptr) *counts = found;
  const auto refused = [&](const std::string& why) {
    const std::string done = found.any() ? fmt::format(" ({})", found.text()) : std::string();
    return Error{fmt::format("{}: after repair{}: {}", surface.name, done, why)};
  };
  if (!closed) return refused(closed.error().message);
  TriangleMesh mesh = settled(closed.value());
  mesh.name = "mesh";
  if (Status s = checkMesh(mesh); !s) return refused(s.error().message);
  mesh.name = surface.name + ", repaired";
  return mesh;
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/repair.h"

#include <fmt/format.h>

#include <utility>

#include "cairn/builder/import.h"
#include "import/close_surface.h"
#include "import/settle.h"
#include "import/stitch.h"

namespace cairn::builder {

bool RepairCounts::any() const {
  return duplicateTriangles + joinedVertices + splitTriangles + collapsedTriangles + filledHoles + turnedTriangles > 0;
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
  return text.empty() ? "nothing" : text;
}

Result<TriangleMesh> repair(const TriangleMesh& surface, RepairCounts* counts) {
  RepairCounts found;
  TriangleMesh stitched = settled(surface);
  if (stitched.triangles.empty())
    return Error{
        fmt::format("{}: no triangle is left when coordinates are rounded to single precision, as those of a "
                    "repaired mesh are; move it nearer to its origin",
                    surface.name)};
  const double tolerance = kStitchTolerance * boundsOf(stitched).diagonal();
  joinBorders(stitched, tolerance, found);
  dropDuplicates(stitched, found);
  splitAtBorderVertices(stitched, tolerance, found);
  Result<TriangleMesh> closed = closeSurface(settled(stitched), found);  // settling drops vertices without triangles
  if (counts != nullptr) *counts = found;
  const auto refused = [&](const std::string& why) {
    return Error{fmt::format("{}: after repair ({}): {}", surface.name, found.text(), why)};
  };
  if (!closed) return refused(closed.error().message);
  TriangleMesh mesh = settled(closed.value());
  mesh.name = "mesh";
  if (Status s = checkMesh(mesh); !s) return refused(s.error().message);
  mesh.name = surface.name + ", repaired";
  return mesh;
}

}  // namespace cairn::builder

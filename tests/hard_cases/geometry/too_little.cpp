// SPDX-License-Identifier: GPL-3.0-or-later
#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "family_demands.h"
#include "geometry_cases.h"

// Less than a solid:
//
//       .
//      / '.
//     /____'        ._____.        .        (nothing)
namespace cairn::hard {
namespace {

Outcome runTooLittle(Effort effort) {
  FamilyDemands demands(effort, 1);
  const auto file = [&](const char* name, const char* text, const char* named) {
    demands.refuses(demands.import(name, text), named);
  };
  file("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "the mesh is open");
  file("triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "the mesh is open");
  file("segment.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "no triangles");
  file("folded.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n", "none of its triangles has an area");
  file("segment.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n", "is not a number of corners");
  file("point.obj", "v 0 0 0\np 1\n", "no triangles");
  file("point.off", "OFF\n1 0 0\n0 0 0\n", "no triangles");
  file("empty.obj", "", "is empty");
  file("empty.ply", "", "is empty");
  file("empty.stl", "", "is empty");
  file("nothing.stl", "solid x\nendsolid x\n", "holds no triangles");
  file("nothing.off", "OFF\n0 0 0\n", "no triangles");

  demands.refuses(builder::buildTree({}, demands.options()), "there are no triangles");
  builder::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}};
  demands.refuses(builder::buildTree(mesh, demands.options()), "there are no triangles");
  mesh.triangles = {{0, 0, 0}};
  demands.refuses(builder::buildTree(mesh, demands.options()), "triangle 0");
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 1}};
  demands.refuses(builder::buildTree(mesh, demands.options()), "triangle 0");
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  demands.refuses(builder::buildTree(mesh, demands.options()), "the mesh is open");
  Outcome outcome;
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase tooLittle() {
  return {
      "G6", "a triangle, a segment, a point, nothing",
      "each of 12 files and 5 meshes in memory is refused by one sentence that names what is missing (proposed list)",
      runTooLittle};
}

}  // namespace cairn::hard

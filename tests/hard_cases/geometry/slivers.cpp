// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "run_program.h"

// Triangles a millionth as high as long, and triangles without any height.
//
//     a-----------------------b
//      \`'-.._          _..-'/      e is 1e-6 of the edge's length from ab: abe is a
//       \     `'--e--''     /       sliver, and stays; a triangle a-a-b or a-m-b has no
//        \       .'.       /        area, and is left out and counted
//         \   .'     '.   /
//          c             d
namespace cairn::hard {
namespace {

/// Each triangle of the mesh cut in three at a point so near its first edge that the part there is `aspect` times as
/// long as high.
builder::TriangleMesh withSlivers(const builder::TriangleMesh& mesh, double aspect) {
  builder::TriangleMesh cut;
  cut.vertices = mesh.vertices;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto c = mesh.corners(i);
    const builder::Triangle& t = mesh.triangles[i];
    const Vec3d middle = (c[0] + c[1]) * 0.5, inwards = c[2] - middle;
    const double height = length(cross(c[1] - c[0], inwards)) / distance(c[0], c[1]);
    const auto added = static_cast<std::uint32_t>(cut.vertices.size());
    cut.vertices.push_back(middle + inwards * (distance(c[0], c[1]) / (aspect * height)));
    cut.triangles.push_back({t[0], t[1], added});
    cut.triangles.push_back({t[1], t[2], added});
    cut.triangles.push_back({t[2], t[0], added});
  }
  return cut;
}

/// Triangles of three different vertices of the mesh on one line: one in the middle of the others.
std::string onOneLine(const builder::TriangleMesh& mesh, std::size_t& count) {
  constexpr std::size_t kVertices = 60;  // enough of a grid's first ones lie so
  std::string text;
  const std::size_t end = std::min(mesh.vertices.size(), kVertices);
  const auto& v = mesh.vertices;
  for (std::size_t i = 0; i < end; ++i)
    for (std::size_t j = i + 1; j < end; ++j)
      for (std::size_t k = 0; k < end; ++k) {
        if (k == i || k == j || !(v[i] + v[j] == v[k] * 2.0)) continue;
        text += "f " + std::to_string(i + 1) + ' ' + std::to_string(k + 1) + ' ' + std::to_string(j + 1) + '\n';
        ++count;
      }
  return text;
}

/// As many triangles without area as the mesh has: a corner named twice, the first again or the second.
std::string withCornersTwice(const builder::TriangleMesh& mesh) {
  std::string text;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto a = std::to_string(mesh.triangles[i][0] + 1), b = std::to_string(mesh.triangles[i][1] + 1);
    text += i % 2 == 0 ? "f " + a + ' ' + a + ' ' + b + '\n' : "f " + b + ' ' + a + ' ' + b + '\n';
  }
  return text;
}

Outcome runSlivers(Effort effort) {
  FamilyDemands demands(effort, 60);
  const builder::TriangleMesh plain = test::meshOf(test::cuboid({2, 1.5, 1}, effort == Effort::quick ? 3 : 8));
  const builder::TriangleMesh slivers = withSlivers(plain, 1e6);

  const test::TemporaryFolder folder;
  std::size_t without = slivers.triangles.size();
  const std::string added = withCornersTwice(slivers) + onOneLine(plain, without);
  const auto file = test::writeText(folder.path() / "slivers.obj", test::objText(slivers) + added);
  builder::ImportCounts counts;
  const auto read = demands.accepted(builder::importMesh(file, &counts));
  const double missed = std::abs(double(counts.degenerateTriangles) - double(without));
  Outcome outcome{
      {{"triangles without area not counted", missed, 0, Bound::atMost, "of " + std::to_string(without), "", 0}}, ""};
  const auto base = demands.build(plain);
  const auto tree = read ? demands.build(*read) : std::nullopt;
  if (base && tree) {
    const double diagonal = builder::boundsOf(plain).diagonal();
    const auto worse = double(tree->levelError(2) - base->levelError(2)) / diagonal;
    outcome.measures.push_back(
        {"worst error of level 2 over the tree's without slivers", 100 * worse, 1, Bound::atMost, "% of size", "", 0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase slivers() {
  return {"G4", "slivers of 1e6 to 1, triangles without area",
          "what has no area is left out and counted, every one; slivers stay, and the tree covers them (proposed list) "
          "and errs at level 2 by no more than 1 % of the size beyond the same solid's without them",
          runSlivers};
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/merge_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "import/across_edge.h"
#include "import/raise_faces.h"
#include "import/self_intersection.h"
#include "import/settle.h"
#include "import/shell_orientation.h"
#include "import/united_surface.h"
#include "import/weld.h"
#include "surface/edges.h"

namespace cairn::builder {
namespace {

/// An edge of more than two triangles from each of its ends, once.
std::vector<HalfEdge> crowdedEdges(const std::vector<HalfEdge>& halfEdges) {
  std::vector<HalfEdge> crowded;
  for (std::size_t first = 0, last = 0; first < halfEdges.size(); first = last) {
    for (last = first; last < halfEdges.size() && halfEdges[last].sameEdge(halfEdges[first]);) ++last;
    if (last - first > 2) crowded.push_back(halfEdges[first]);
  }
  return crowded;
}

/// A square tube around an edge, a radius longer at each end.
void addBead(LabelledMesh& labelled, const HalfEdge& edge, double radius) {
  TriangleMesh& mesh = labelled.mesh;
  const Vec3d from = mesh.vertices[edge.from], to = mesh.vertices[edge.to];
  const Vec3d along = normalized(to - from);
  const auto [u, v] = acrossEdge(along);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& end : {from - along * radius, to + along * radius})
    for (const Vec3d& aside : {u, v, u * -1.0, v * -1.0}) mesh.vertices.push_back(end + aside * radius);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    labelled.body.push_back(kBead);
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    add(i, j, j + 4);
    add(i, j + 4, i + 4);
  }
  add(0, 2, 1);
  add(0, 3, 2);
  add(4, 5, 6);
  add(4, 6, 7);
}

/// Rounds to multiples of a float's unit and drops triangles that lost their area; the others keep their labels.
void roundTo(double unit, LabelledMesh& labelled) {
  TriangleMesh& mesh = labelled.mesh;
  for (Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] = unit * std::nearbyint(v[axis] / unit) + 0.0;
  std::size_t kept = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (isDegenerate(mesh.corners(t))) continue;
    labelled.body[kept] = labelled.body[t];
    mesh.triangles[kept++] = mesh.triangles[t];
  }
  labelled.body.resize(kept);
  mesh.triangles.resize(kept);
  mesh = settled(mesh);
}

LabelledMesh labelledAs(const LabelledMesh& source, PartsOfMesh parts) {
  LabelledMesh labelled;
  for (const std::uint32_t t : parts.source) labelled.body.push_back(source.body[t]);
  labelled.mesh = std::move(parts.mesh);
  return labelled;
}

/// Adds what bodies wind around backwards, a little larger: it touches the rest along lines, and then overlaps
/// it.
void addFolds(LabelledMesh folds, double unit, double amount, LabelledMesh& labelled) {
  roundTo(unit, folds);
  labelled.foldedTriangles = folds.mesh.triangles.size();
  std::vector<std::uint32_t> all(folds.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  raiseFaces(folds.mesh, all, amount);
  roundTo(unit, folds);
  const auto first = static_cast<std::uint32_t>(labelled.mesh.vertices.size());
  for (const Vec3d& v : folds.mesh.vertices) labelled.mesh.vertices.push_back(v);
  for (const auto& [a, b, c] : folds.mesh.triangles)
    labelled.mesh.triangles.push_back({a + first, b + first, c + first});
  labelled.body.insert(labelled.body.end(), folds.body.begin(), folds.body.end());
}

/// Replaces the mesh by what its bodies enclose, rounded. Returns its folds, and the number of cut triangles.
Result<LabelledMesh> united(LabelledMesh& labelled, const BodiesOfMesh& bodies, double unit) {
  Result<UnitedSurface> surface = unitedSurface(labelled.mesh, bodies);
  if (!surface) return surface.error();
  LabelledMesh folds = labelledAs(labelled, std::move(surface.value().backward));
  folds.cutTriangles = surface.value().cutTriangles;
  LabelledMesh result = labelledAs(labelled, std::move(surface.value().forward));
  labelled.mesh = std::move(result.mesh);
  labelled.body = std::move(result.body);
  roundTo(unit, labelled);
  return folds;
}

Status uniteBodies(LabelledMesh& labelled, const std::vector<std::uint32_t>& hollowOf, double unit, double amount) {
  roundTo(unit, labelled);
  Result<LabelledMesh> folds = united(labelled, {labelled.body, hollowOf}, unit);
  if (!folds) return folds.error();
  labelled.cutTriangles = folds.value().cutTriangles;
  if (!folds.value().mesh.triangles.empty()) addFolds(std::move(folds).value(), unit, amount, labelled);
  return {};
}

/// As one body, around which only slivers of rounding wind backwards.
Status uniteAgain(LabelledMesh& labelled, double unit) {
  const BodiesOfMesh one{std::vector<std::uint32_t>(labelled.mesh.triangles.size(), 0), {0}};
  const Result<LabelledMesh> slivers = united(labelled, one, unit);
  return slivers ? Status() : slivers.error();
}

Error notApart(const TriangleMesh& mesh) {
  const auto pair = findSelfIntersection(mesh);
  const Vec3d at = pair ? mesh.corners(pair->first)[0] : Vec3d();
  const std::string where = pair ? fmt::format("near ({:.6g}, {:.6g}, {:.6g}) ", at.x, at.y, at.z) : std::string();
  return Error{
      fmt::format("its bodies are united, but {}surfaces do not stay apart when rounded to single precision; "
                  "move the mesh nearer to its origin, unite them in a modelling program or wrap it",
                  where)};
}

}  // namespace

double unitOf(const TriangleMesh& mesh) {
  double farthest = 0;
  for (const Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(v[axis]));
  return std::ldexp(1.0, std::ilogb(farthest) - 23);
}

Result<LabelledMesh> mergeBodies(LabelledMesh source, const std::vector<std::uint32_t>& hollowOf, double beadRadius) {
  // Rounding moves vertices by less than a unit of floats. What it makes meet is smaller each time; two rounds are
  // usual. Where they do not help, pieces multiply.
  constexpr int kMaxRounds = 12, kMostPieces = 4;
  // What is moved by fewer units of floats is flat after rounding.
  constexpr double kLeastUnits = 32;
  LabelledMesh labelled = std::move(source);
  const double unit = unitOf(labelled.mesh), radius = std::max(beadRadius, kLeastUnits * unit);
  std::size_t pieces = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::vector<HalfEdge> halfEdges = sortedHalfEdges(labelled.mesh);
    const std::vector<HalfEdge> crowded = crowdedEdges(halfEdges);
    const bool crosses = findSelfIntersection(labelled.mesh).has_value();
    if (!crosses && round > 0) {
      for (const HalfEdge& edge : crowded) addBead(labelled, edge, radius);
      labelled.beads += crowded.size();
    }
    if (!crosses && crowded.empty() && !findMisplacedShell(labelled.mesh, shellsOf(labelled.mesh, halfEdges)))
      return labelled;
    const Status united =
        round == 0 ? uniteBodies(labelled, hollowOf, unit, kRaised * radius) : uniteAgain(labelled, unit);
    if (!united) return united.error();
    if (round == 0) pieces = kMostPieces * labelled.mesh.triangles.size();
    if (labelled.mesh.triangles.size() > pieces) break;
  }
  return notApart(labelled.mesh);
}

}  // namespace cairn::builder

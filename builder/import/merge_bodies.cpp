// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/merge_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

/// Rounds to multiples of the axes' units and drops triangles that lost their area; the others keep their labels.
void roundTo(const Vec3d& units, LabelledMesh& labelled) {
  TriangleMesh& mesh = labelled.mesh;
  for (Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] = units[axis] * std::nearbyint(v[axis] / units[axis]) + 0.0;
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
void addFolds(LabelledMesh folds, const Vec3d& units, double amount, LabelledMesh& labelled) {
  roundTo(units, folds);
  labelled.foldedTriangles = folds.mesh.triangles.size();
  std::vector<std::uint32_t> all(folds.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  raiseFaces(folds.mesh, all, amount);
  roundTo(units, folds);
  const auto first = static_cast<std::uint32_t>(labelled.mesh.vertices.size());
  for (const Vec3d& v : folds.mesh.vertices) labelled.mesh.vertices.push_back(v);
  for (const auto& [a, b, c] : folds.mesh.triangles)
    labelled.mesh.triangles.push_back({a + first, b + first, c + first});
  labelled.body.insert(labelled.body.end(), folds.body.begin(), folds.body.end());
}

/// Replaces the mesh by what its bodies enclose, rounded. Returns its folds, and the number of cut triangles.
Result<LabelledMesh> united(LabelledMesh& labelled, const BodiesOfMesh& bodies, const Vec3d& units) {
  Result<UnitedSurface> surface = unitedSurface(labelled.mesh, bodies);
  if (!surface) return surface.error();
  LabelledMesh folds = labelledAs(labelled, std::move(surface.value().backward));
  folds.cutTriangles = surface.value().cutTriangles;
  LabelledMesh result = labelledAs(labelled, std::move(surface.value().forward));
  labelled.mesh = std::move(result.mesh);
  labelled.body = std::move(result.body);
  roundTo(units, labelled);
  return folds;
}

Status uniteBodies(LabelledMesh& labelled, const std::vector<std::uint32_t>& hollowOf, const Vec3d& units,
                   double amount) {
  roundTo(units, labelled);
  Result<LabelledMesh> folds = united(labelled, {labelled.body, hollowOf}, units);
  if (!folds) return folds.error();
  labelled.cutTriangles = folds.value().cutTriangles;
  if (!folds.value().mesh.triangles.empty()) addFolds(std::move(folds).value(), units, amount, labelled);
  return {};
}

/// As one body, around which only slivers of rounding wind backwards.
Status uniteAgain(LabelledMesh& labelled, const Vec3d& units) {
  const BodiesOfMesh one{std::vector<std::uint32_t>(labelled.mesh.triangles.size(), 0), {0}};
  const Result<LabelledMesh> slivers = united(labelled, one, units);
  return slivers ? Status() : slivers.error();
}

Error notApart(const TriangleMesh& mesh) {
  const auto pair = findSelfIntersection(mesh);
  if (!pair)
    return Error{"its bodies are united, but still touch in edges; unite them in a modelling program or wrap the mesh"};
  const Vec3d at = mesh.corners(pair->first)[0];
  return Error{
      fmt::format("its bodies are united, but near ({:.6g}, {:.6g}, {:.6g}) surfaces do not stay apart when rounded to "
                  "single precision; unite them in a modelling program or wrap it",
                  at.x, at.y, at.z)};
}

}  // namespace

Vec3d unitsOf(const TriangleMesh& mesh) {
  Vec3d farthest(std::numeric_limits<float>::min(), std::numeric_limits<float>::min(),
                 std::numeric_limits<float>::min());
  for (const Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) farthest[axis] = std::max(farthest[axis], std::abs(v[axis]));
  Vec3d units;
  for (int axis = 0; axis < 3; ++axis) units[axis] = std::ldexp(1.0, std::ilogb(farthest[axis]) - 23);
  return units;
}

Result<LabelledMesh> mergeBodies(LabelledMesh source, const std::vector<std::uint32_t>& hollowOf, double beadRadius) {
  // Rounding moves vertices by less than a unit of floats. What it makes meet is smaller each time; two rounds are
  // usual. Where they do not help, pieces multiply.
  constexpr int kMaxRounds = 12;
  constexpr std::size_t kMostPieces = 4, kAnyNumber = std::numeric_limits<std::size_t>::max();
  // What is moved by fewer units of floats is flat after rounding.
  constexpr double kLeastUnits = 32;
  LabelledMesh labelled = std::move(source);
  Vec3d units = unitsOf(labelled.mesh);
  const auto radius = [&] { return std::max(beadRadius, kLeastUnits * std::max({units.x, units.y, units.z})); };
  std::size_t pieces = kAnyNumber;
  std::vector<Triangle> before;
  for (int round = 0;; ++round) {
    const std::vector<HalfEdge> halfEdges = sortedHalfEdges(labelled.mesh);
    const std::vector<HalfEdge> crowded = crowdedEdges(halfEdges);
    const bool crosses = findSelfIntersection(labelled.mesh).has_value();
    if (!crosses && crowded.empty() && !findMisplacedShell(labelled.mesh, shellsOf(labelled.mesh, halfEdges)))
      return labelled;
    if (round == kMaxRounds || labelled.mesh.triangles.size() > pieces) return notApart(labelled.mesh);
    // Rounding may give back what was cut; on a coarser grid it does not.
    if (labelled.mesh.triangles == before) units = units * 2.0;
    before = labelled.mesh.triangles;
    if (!crosses && round > 0) {
      for (const HalfEdge& edge : crowded) addBead(labelled, edge, radius());
      labelled.beads += crowded.size();
      pieces = kAnyNumber;
    }
    const Status united =
        round == 0 ? uniteBodies(labelled, hollowOf, units, kRaised * radius()) : uniteAgain(labelled, units);
    if (!united) return united.error();
    if (pieces == kAnyNumber) pieces = kMostPieces * labelled.mesh.triangles.size();
  }
}

}  // namespace cairn::builder

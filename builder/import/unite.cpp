// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/unite.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "import/bodies.h"
#include "import/merge_bodies.h"
#include "import/near_triangles.h"
#include "import/part_flush.h"
#include "import/raise_faces.h"
#include "import/settle.h"
#include "surface/winding_number.h"

namespace cairn::builder {
namespace {

/// Bodies in groups; those of one group are one solid.
struct Groups {
  std::vector<std::uint32_t> leader;

  std::uint32_t of(std::uint32_t body) const {
    while (leader[body] != body) body = leader[body];
    return body;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({of(a), of(b)});
    leader[high] = low;
  }
};

struct Merging {
  LabelledMesh result;
  std::vector<std::uint32_t> hollowOf;
  Groups groups;
  std::set<std::uint32_t> present;  ///< bodies with a part in the surface
  std::set<std::uint32_t> joined;   ///< those that share a shell with another one
};

void noteShells(Merging& merging) {
  const TriangleMesh& mesh = merging.result.mesh;
  const Shells shells = shellsOf(mesh, sortedHalfEdges(mesh));
  std::vector<std::set<std::uint32_t>> bodies(shells.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (const std::uint32_t body = merging.result.body[t]; body != kBead) {
      merging.present.insert(body);
      bodies[shells.ofTriangle[t]].insert(merging.hollowOf[body]);
    }
  for (const std::set<std::uint32_t>& here : bodies) {
    for (const std::uint32_t body : here) merging.groups.join(*here.begin(), body);
    if (here.size() > 1) merging.joined.insert(here.begin(), here.end());
  }
}

Result<Merging> merged(const TriangleMesh& mesh, const Shells& bodies, double tolerance) {
  Merging merging;
  TriangleMesh outward = mesh;
  merging.hollowOf = faceOutward(outward, bodies);
  merging.groups.leader.resize(bodies.count);
  std::iota(merging.groups.leader.begin(), merging.groups.leader.end(), 0U);
  Result<LabelledMesh> result = mergeBodies({mesh, bodies.ofTriangle}, merging.hollowOf, tolerance);
  if (!result) return result.error();
  merging.result = std::move(result).value();
  noteShells(merging);
  for (std::uint32_t b = 0; b < bodies.count; ++b) merging.groups.join(merging.hollowOf[b], b);
  return merging;
}

bool areNear(const Bounds& a, const Bounds& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] > b.upper[axis] + distance || b.lower[axis] > a.upper[axis] + distance) return false;
  return true;
}

/// A body that is in no surface, though it does not lie in the solid either: rounding to floats has left nothing of it.
Status checkNoneIsLost(const TriangleMesh& mesh, const Shells& bodies, const Merging& merging) {
  const std::vector<Body> parts = separated(mesh, bodies);
  for (std::uint32_t b = 0; b < bodies.count; ++b) {
    if (merging.present.contains(b) || merging.hollowOf[b] != b) continue;
    std::vector<Vec3d> points = parts[b].mesh.vertices;
    points.push_back(parts[b].bounds.center());
    const auto isOutside = [&](const Vec3d& p) { return windingNumber(merging.result.mesh, p) < 0.25; };
    if (!std::ranges::all_of(points, isOutside)) continue;
    return Error{
        fmt::format("rounding to single precision leaves nothing of its body near ({:.6g}, {:.6g}, {:.6g}); move "
                    "the mesh nearer to its origin, or leave that body out",
                    points[0].x, points[0].y, points[0].z)};
  }
  return {};
}

void noteCounts(const Merging& merging, RepairCounts& counts) {
  counts.cutTriangles = merging.result.cutTriangles;
  counts.foldedTriangles = merging.result.foldedTriangles;
  counts.beadedEdges = merging.result.beads;
  counts.unitedBodies = merging.joined.size();
  counts.enclosedBodies += merging.hollowOf.size() - merging.present.size();
}

/// Moves faces of bodies into neighbours that are near but not joined. Returns the number of pairs.
std::size_t closeGaps(TriangleMesh& mesh, const Shells& bodies, const Merging& merging, double tolerance) {
  std::vector<Body> parts = separated(mesh, bodies);
  std::vector<std::set<std::uint32_t>> raised(bodies.count);
  std::size_t pairs = 0;
  for (const std::uint32_t a : merging.present)
    for (const std::uint32_t b : merging.present) {
      if (a >= b || merging.groups.of(a) == merging.groups.of(b)) continue;
      if (!areNear(parts[a].bounds, parts[b].bounds, tolerance)) continue;
      const auto [small, large] =
          parts[a].bounds.diagonal() < parts[b].bounds.diagonal() ? std::pair(a, b) : std::pair(b, a);
      const std::vector<std::uint32_t> near = trianglesNear(parts[small].mesh, parts[large].mesh, tolerance);
      raised[small].insert(near.begin(), near.end());
      pairs += near.empty() ? 0 : 1;
    }
  for (std::uint32_t b = 0; b < bodies.count; ++b) {
    if (raised[b].empty()) continue;
    raiseFaces(parts[b].mesh, {raised[b].begin(), raised[b].end()}, kRaised * tolerance);
    putBack(parts[b], mesh);
  }
  return pairs;
}

Result<TriangleMesh> united(const TriangleMesh& mesh, double tolerance, double flush, RepairCounts& counts) {
  // A moved face may come near a third body.
  constexpr int kMaxRounds = 3;
  TriangleMesh source = mesh;
  for (int round = 0;; ++round) {
    counts.movedTriangles += partFlushFaces(source, flush);
    const Shells bodies = bodiesOf(source);
    Result<Merging> merging = merged(source, bodies, tolerance);
    if (!merging) return merging.error();
    const bool mayMove = round < kMaxRounds && tolerance > 0;
    const std::size_t gaps = mayMove ? closeGaps(source, bodies, merging.value(), tolerance) : 0;
    counts.closedGaps += gaps;
    if (gaps == 0) {
      if (Status s = checkNoneIsLost(source, bodies, merging.value()); !s) return s.error();
      noteCounts(merging.value(), counts);
      return std::move(merging.value().result.mesh);
    }
    source = settled(source);
  }
}

}  // namespace

Result<TriangleMesh> unite(const TriangleMesh& mesh, double tolerance, RepairCounts& counts) {
  // Rounding of a turned or scaled part takes a few units of floats; a distance of so many keeps its cuts apart. Where
  // many parts meet in one place it takes more.
  const Vec3d ofAxes = unitsOf(mesh);
  const double unit = std::max({ofAxes.x, ofAxes.y, ofAxes.z});
  for (double units = 32;; units *= 4) {
    constexpr double kMostUnits = 512;
    RepairCounts tried = counts;
    Result<TriangleMesh> result = united(mesh, tolerance, std::min(tolerance, units * unit), tried);
    if (!result && units < kMostUnits) continue;
    counts = tried;
    return result;
  }
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "import/across_edge.h"
#include "import/self_intersection.h"
#include "surface/mass_properties.h"
#include "surface/winding_number.h"

namespace cairn::builder {
namespace {

int directionOf(const HalfEdge& h) {
  return h.from < h.to ? 1 : -1;
}

/// Sets of triangles, named by their lowest one.
class TriangleSets {
 public:
  explicit TriangleSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t of(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({of(a), of(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Calls `visit(first, last)` with the half-edges of each edge.
template <class Visit>
void forEachEdge(const std::vector<HalfEdge>& halfEdges, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < halfEdges.size(); first = last) {
    for (last = first; last < halfEdges.size() && halfEdges[last].sameEdge(halfEdges[first]);) ++last;
    visit(first, last);
  }
}

/// A triangle at an edge of many.
struct Spoke {
  double angle = 0;    ///< around the edge, counter-clockwise seen from its higher vertex
  bool opens = false;  ///< the solid begins here
  std::uint32_t triangle = 0;
};

Spoke spokeOf(const TriangleMesh& mesh, const HalfEdge& h) {
  const Vec3d from = mesh.vertices[h.low()], along = normalized(mesh.vertices[h.high()] - from);
  const auto [u, v] = acrossEdge(along);
  const Vec3d out = mesh.vertices[mesh.triangles[h.triangle][(h.side + 2) % 3]] - from;
  return {std::atan2(dot(out, v), dot(out, u)), directionOf(h) < 0, h.triangle};
}

/// Joins the two sides of each wedge of solid at an edge. Where two wedges meet in a plane, one ends before the other
/// begins.
void joinWedges(std::vector<Spoke> spokes, TriangleSets& sets) {
  constexpr double kSamePlane = 1e-6;
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    return std::pair(a.angle, a.triangle) < std::pair(b.angle, b.triangle);
  });
  for (std::size_t i = 1; i < spokes.size(); ++i)
    for (std::size_t j = i; j > 0 && spokes[j - 1].opens && !spokes[j].opens; --j) {
      if (spokes[j].angle - spokes[j - 1].angle > kSamePlane) break;
      std::swap(spokes[j - 1].triangle, spokes[j].triangle);
      std::swap(spokes[j - 1].opens, spokes[j].opens);
    }
  std::vector<std::uint32_t> open;
  std::vector<char> isClosed(spokes.size(), 0);
  for (int turn = 0; turn < 2; ++turn)  // a wedge may lie across the angle at which the sweep begins
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (spokes[i].opens && turn == 0) open.push_back(spokes[i].triangle);
      if (spokes[i].opens || isClosed[i] || open.empty()) continue;
      sets.join(open.back(), spokes[i].triangle);
      open.pop_back();
      isClosed[i] = 1;
    }
}

bool isWithin(const Bounds& inner, const Bounds& outer) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.lower[axis] < outer.lower[axis] || inner.upper[axis] > outer.upper[axis]) return false;
  return true;
}

bool holds(const Body& outer, const Body& inner) {
  return isWithin(inner.bounds, outer.bounds) && std::lround(windingNumber(outer.mesh, inner.mesh.vertices[0])) != 0 &&
         !findCrossing(outer.mesh, inner.mesh);
}

/// For a body: the largest one that holds it, and the smallest one of those that face the other way.
struct Holders {
  std::optional<std::uint32_t> outermost, opposite;
};

Holders holdersOf(const std::vector<Body>& list, std::uint32_t inner) {
  Holders holders;
  const auto size = [&](std::uint32_t body) { return list[body].bounds.diagonal(); };
  for (std::uint32_t outer = 0; outer < list.size(); ++outer) {
    if (outer == inner || !holds(list[outer], list[inner])) continue;
    if (!holders.outermost || size(outer) > size(*holders.outermost)) holders.outermost = outer;
    if (list[outer].facesOutward == list[inner].facesOutward) continue;
    if (!holders.opposite || size(outer) < size(*holders.opposite)) holders.opposite = outer;
  }
  return holders;
}

}  // namespace

bool isBalanced(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> halfEdges = sortedHalfEdges(mesh);
  bool balanced = true;
  forEachEdge(halfEdges, [&](std::size_t first, std::size_t last) {
    int sum = 0;
    for (std::size_t h = first; h < last; ++h) sum += directionOf(halfEdges[h]);
    balanced = balanced && sum == 0;
  });
  return balanced;
}

Shells bodiesOf(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> halfEdges = sortedHalfEdges(mesh);
  TriangleSets sets(mesh.triangles.size());
  forEachEdge(halfEdges, [&](std::size_t first, std::size_t last) {
    if (last - first == 2) return sets.join(halfEdges[first].triangle, halfEdges[first + 1].triangle);
    std::vector<Spoke> spokes;
    for (std::size_t h = first; h < last; ++h) spokes.push_back(spokeOf(mesh, halfEdges[h]));
    joinWedges(std::move(spokes), sets);
  });
  Shells bodies{std::vector<std::uint32_t>(mesh.triangles.size()), 0};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    bodies.ofTriangle[t] = sets.of(t) == t ? bodies.count++ : bodies.ofTriangle[sets.of(t)];
  return bodies;
}

std::vector<Body> separated(const TriangleMesh& mesh, const Shells& bodies) {
  std::vector<Body> list(bodies.count);
  std::vector<std::map<std::uint32_t, std::uint32_t>> numbers(bodies.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Body& body = list[bodies.ofTriangle[t]];
    Triangle own{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto next = static_cast<std::uint32_t>(body.mesh.vertices.size());
      const auto [found, isNew] = numbers[bodies.ofTriangle[t]].emplace(mesh.triangles[t][i], next);
      if (isNew) body.mesh.vertices.push_back(mesh.vertices[mesh.triangles[t][i]]);
      own[i] = found->second;
    }
    body.mesh.triangles.push_back(own);
    body.triangles.push_back(t);
  }
  for (Body& body : list) {
    body.bounds = boundsOf(body.mesh);
    body.facesOutward = signedVolume(body.mesh) >= 0;
  }
  return list;
}

void putBack(const Body& body, TriangleMesh& whole) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), body.mesh.vertices.begin(), body.mesh.vertices.end());
  for (std::size_t t = 0; t < body.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) whole.triangles[body.triangles[t]][i] = first + body.mesh.triangles[t][i];
}

std::vector<std::uint32_t> faceOutward(TriangleMesh& mesh, const Shells& bodies) {
  std::vector<std::uint32_t> hollowOf(bodies.count);
  std::iota(hollowOf.begin(), hollowOf.end(), 0U);
  const std::vector<Body> list = separated(mesh, bodies);
  if (std::all_of(list.begin(), list.end(), [](const Body& b) { return b.facesOutward; })) return hollowOf;
  std::vector<char> isTurned(bodies.count, 0);
  for (std::uint32_t b = 0; b < bodies.count; ++b) {
    const Holders holders = holdersOf(list, b);
    const bool isHollow = holders.outermost && list[*holders.outermost].facesOutward != list[b].facesOutward;
    isTurned[b] = list[b].facesOutward == isHollow;
    if (isHollow) hollowOf[b] = *holders.opposite;
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (isTurned[bodies.ofTriangle[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return hollowOf;
}

}  // namespace cairn::builder

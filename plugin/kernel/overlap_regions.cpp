// SPDX-License-Identifier: Zlib
#include "kernel/overlap_regions.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "kernel/explained.h"

namespace cairn::bullet {

namespace {

constexpr std::uint32_t kOutside = 0xFFFFFFFFU;
// Charged for a ray, which passes some dozens of balls.
constexpr std::uint32_t kRayCost = 32 * kOverlapTestCost;

bool isSamePlace(const Crossing& x, const Crossing& y) {
  return x.isEdgeOfA == y.isEdgeOfA && x.edge == y.edge && x.face == y.face;
}

bool isSameEdge(const Crossing& x, const Crossing& y) {
  return x.isEdgeOfA == y.isEdgeOfA && x.edge == y.edge;
}

}  // namespace

// Precondition: `crossings` is sorted.
std::span<const Crossing> OverlapRegions::Question::crossingsOf(bool isOfA, std::uint32_t edge) const {
  const auto key = [](const Crossing& c) { return std::pair(c.isEdgeOfA, c.edge); };
  const auto first = std::ranges::lower_bound(crossings, std::pair(isOfA, edge), {}, key);
  const auto last =
      std::find_if(first, crossings.end(), [&](const Crossing& c) { return key(c) != std::pair(isOfA, edge); });
  return {first, last};
}

std::uint32_t OverlapRegions::rootOf(std::uint32_t region) {
  while (parent_[region] != region) region = parent_[region] = parent_[parent_[region]];
  return region;
}

void OverlapRegions::join(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t rootX = rootOf(x), rootY = rootOf(y);
  parent_[std::max(rootX, rootY)] = std::min(rootX, rootY);
}

std::optional<std::span<const OverlapRegion>> OverlapRegions::find(const SurfacePair& surfaces,
                                                                   const ContactLimits& limits,
                                                                   std::span<const FeatureContact> contacts,
                                                                   std::vector<Crossing>& crossings, Budget& budget) {
  points_.clear();
  isCut_ = false;
  regions_.clear();
  if (crossings.empty()) return regions_;
  std::ranges::sort(crossings, {}, &Crossing::place);
  crossings.erase(std::unique(crossings.begin(), crossings.end(), isSamePlace), crossings.end());
  parent_.resize(crossings.size());
  std::iota(parent_.begin(), parent_.end(), 0U);
  const Question question{surfaces, limits, contacts, crossings, budget};
  nearCrossings_ = {crossings[0].position, crossings[0].position};
  for (const Crossing& c : crossings) nearCrossings_.add(c.position);
  nearCrossings_ = nearCrossings_.grown(limits.contactDistance);
  joinCrossings(question);
  for (std::uint32_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    points_.push_back({c.position, c.isEdgeOfA, true, c.edge, c.face, i});
  }
  flood(question);
  if (isCut_) return {};
  gather(question);
  return regions_;
}

void OverlapRegions::addArea(Area& area, const Vec3& part) {
  area.area += part;
  area.sum += length(part);
}

void OverlapRegions::gather(const Question& question) {
  for (OverlapPoint& point : points_) point.region = rootOf(point.region);
  // The key is unique, so the order is defined; a stable sort would allocate.
  std::ranges::sort(points_, {}, [](const OverlapPoint& p) {
    return std::tuple(p.region, !p.isCrossing, p.isOfA, p.feature, p.face);
  });
  areas_.assign(question.crossings.size(), {});
  for (std::size_t i = 1; i < trianglePairs_.size(); ++i)
    if (trianglePairs_[i].first == trianglePairs_[i - 1].first)
      addArea(areas_[rootOf(trianglePairs_[i].second)], areaBetween(question, i));
  for (std::span<const OverlapPoint> points = points_; !points.empty();) {
    const std::uint32_t region = points[0].region;
    const auto end = std::ranges::find_if(points, [&](const OverlapPoint& p) { return p.region != region; });
    const auto own = points.first(static_cast<std::size_t>(end - points.begin()));
    regions_.push_back({own, areas_[region].area, areas_[region].sum});
    points = points.subspan(own.size());
  }
}

// Two triangles cross along a line between two crossings of their edges. On A's surface the border of the part inside B
// runs along the cross product of their normals.
Vec3 OverlapRegions::areaBetween(const Question& question, std::size_t at) const {
  const std::span<const Crossing> crossings = question.crossings;
  const SurfacePair& surfaces = question.surfaces;
  const auto& [key, second] = trianglePairs_[at];
  const Vec3 origin = crossings[0].position;
  const Vec3 from = crossings[trianglePairs_[at - 1].second].position - origin,
             to = crossings[second].position - origin;
  const Vec3 a = surfaces.a.directionToPair(surfaces.a.features().faces()[key >> 32].normal);
  const Vec3 b = surfaces.b.directionToPair(surfaces.b.features().faces()[key & 0xFFFFFFFFU].normal);
  return cross(from, to) * (dot(to - from, cross(a, b)) < 0 ? -0.5F : 0.5F);
}

// Two triangles cross along a line, and its ends are crossings of their edges.
void OverlapRegions::joinCrossings(const Question& question) {
  const std::span<const Crossing> crossings = question.crossings;
  trianglePairs_.clear();
  for (std::uint32_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    for (const std::uint32_t t : question.edgeOf(c).triangle) {
      if (t == SurfaceEdge::kNone) continue;
      const std::uint64_t ofA = c.isEdgeOfA ? t : c.face, ofB = c.isEdgeOfA ? c.face : t;
      trianglePairs_.emplace_back(ofA << 32 | ofB, i);
    }
    const bool goesOn = i > 0 && isSameEdge(crossings[i - 1], c);
    if (goesOn && crossings[i - 1].enters && !c.enters) join(i - 1, i);
  }
  std::ranges::sort(trianglePairs_);
  for (std::size_t i = 1; i < trianglePairs_.size(); ++i)
    if (trianglePairs_[i].first == trianglePairs_[i - 1].first)
      join(trianglePairs_[i - 1].second, trianglePairs_[i].second);
}

// The crossings of a vertex's edges tell on which side it is. If they disagree, or there are none, a contact that
// explains the vertex decides, or else a ray.
bool OverlapRegions::isInside(const Question& question, bool isOfA, std::uint32_t vertex, const Vec3& place) {
  const PlacedSurface &side = question.side(isOfA), &other = question.side(!isOfA);
  bool isInside = false, isOutside = false;
  for (const std::uint32_t edge : side.features().edgesAround(vertex)) {
    const std::span<const Crossing> crossings = question.crossingsOf(isOfA, edge);
    if (crossings.empty()) continue;
    const bool isFirst = side.features().edges()[edge].vertex[0] == vertex;
    const bool isWithin = isFirst ? !crossings.front().enters : crossings.back().enters;
    (isWithin ? isInside : isOutside) = true;
  }
  if (isInside != isOutside) return isInside;
  // A contact's plane has no end, so explanations count only near the crossings.
  if (nearCrossings_.holds(place) && isExplained(question.contacts, place, isOfA, question.limits)) return true;
  isCut_ = isCut_ || !question.budget.charge(kRayCost);
  if (isCut_) return false;
  return ray_.isInside(other.mesh, side.toOther * side.vertex(vertex));
}

// Adds the vertex to the region if it is new and inside. Returns the index of its point.
std::uint32_t OverlapRegions::visit(const Question& question, bool isOfA, std::uint32_t vertex, std::uint32_t region) {
  Visit& visited = visited_[isOfA ? 0 : 1][vertex];
  if (visited.search == search_) return visited.point;
  const PlacedSurface& side = question.side(isOfA);
  const Vec3 place = side.toPair * side.vertex(vertex);
  visited = {search_, kOutside};
  if (!isInside(question, isOfA, vertex, place)) return kOutside;
  visited.point = static_cast<std::uint32_t>(points_.size());
  points_.push_back({place, isOfA, false, vertex, 0, region});
  waiting_.push_back(visited.point);
  return visited.point;
}

void OverlapRegions::seed(const Question& question, const Crossing& crossing, std::uint32_t vertex,
                          std::uint32_t region) {
  const std::uint32_t point = visit(question, crossing.isEdgeOfA, vertex, region);
  if (point != kOutside) join(points_[point].region, region);
}

void OverlapRegions::flood(const Question& question) {
  if (++search_ == 0) {  // all stamps are old
    for (std::vector<Visit>& visited : visited_) visited.clear();
    search_ = 1;
  }
  for (const bool isOfA : {true, false}) {
    std::vector<Visit>& visited = visited_[isOfA ? 0 : 1];
    const std::size_t count = question.side(isOfA).mesh.vertices.size();
    if (visited.size() < count) visited.resize(count);
  }
  waiting_.clear();
  const std::span<const Crossing> crossings = question.crossings;
  for (std::uint32_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    const SurfaceEdge& edge = question.edgeOf(c);
    const bool isFirst = i == 0 || !isSameEdge(crossings[i - 1], c);
    const bool isLast = i + 1 == crossings.size() || !isSameEdge(c, crossings[i + 1]);
    if (isLast && c.enters) seed(question, c, edge.vertex[1], i);
    if (isFirst && !c.enters) seed(question, c, edge.vertex[0], i);
  }
  while (!waiting_.empty() && !isCut_) {
    const OverlapPoint here = points_[waiting_.back()];
    waiting_.pop_back();
    const SurfaceFeatures& features = question.side(here.isOfA).features();
    for (const std::uint32_t edge : features.edgesAround(here.feature)) {
      if (!question.crossingsOf(here.isOfA, edge).empty()) continue;
      const std::uint32_t next = visit(question, here.isOfA, features.across(edge, here.feature), here.region);
      if (next != kOutside) join(points_[next].region, here.region);
    }
  }
}

}  // namespace cairn::bullet

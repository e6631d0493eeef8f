// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/center_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace cairn::builder {
namespace {

/// Number of octree levels before lists are kept, and of further levels for the kept nodes.
constexpr int kFirstLevels = 3;
constexpr int kKeptLevels = 2;
/// Limits of one kept node in one search: cells to report and cells to examine.
constexpr std::size_t kMaxFound = 2;
constexpr int kMaxVisits = 1000;

/// The least number not below `x` with 10 significant bits. Some forty halvings and sums of the parts stay exact.
double roundedUp(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::ceil(std::ldexp(mantissa, 10)), exponent - 10);
}

CenterCell octantOf(const CenterCell& cell, int octant) {
  const double h = cell.half / 2;
  return {cell.center + Vec3d{octant & 1 ? h : -h, octant & 2 ? h : -h, octant & 4 ? h : -h}, h};
}

/// The path of octants from the root to the kept node that holds `point`. Precondition: the point lies in the root.
std::uint32_t octantsOf(const Vec3d& point, double rootHalf) {
  CenterCell cell{{0, 0, 0}, rootHalf};
  std::uint32_t path = 0;
  for (int level = 0; level < kFirstLevels + kKeptLevels; ++level) {
    const Vec3d& c = cell.center;
    const int octant = (point.x > c.x ? 1 : 0) | (point.y > c.y ? 2 : 0) | (point.z > c.z ? 4 : 0);
    path = 8 * path + static_cast<std::uint32_t>(octant);
    cell = octantOf(cell, octant);
  }
  return path;
}

std::vector<std::uint32_t> allOf(std::size_t count) {
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

struct Obstacle {
  double sq;  // squared distance from the cell's centre
  Vec3d offset;
  std::uint32_t index;
};

}  // namespace

CenterSearch::CenterSearch(std::vector<Vec3d> points, std::vector<Vec3d> outside, double half, double displacement,
                           const KeepGoing& keepGoing)
    : points_(std::move(points)), outside_(std::move(outside)), half_(roundedUp(half)) {
  const CenterCell root{{0, 0, 0}, half_};
  // Let D bound all lengths that occur (points lie in the root). Displacement of two ends changes the difference of
  // squares by less than 8 D displacement. The some twenty operations round by less than 64 units of D^2.
  const double longest = 2 * std::numbers::sqrt3 * root.half;
  guard_ = 8 * longest * displacement + 64 * 0x1p-53 * longest * longest;
  const std::vector<std::uint32_t> everyPoint = allOf(points_.size()), everyOutside = allOf(outside_.size());
  constexpr int kFirstCells = 1 << (3 * kFirstLevels);
  std::vector<std::vector<Node>> parts(kFirstCells);
  std::atomic<bool> stopped = false;
  tbb::parallel_for(0, kFirstCells, [&](int i) {
    if (stopped) return;
    CenterCell cell = root;
    for (int level = kFirstLevels; level-- > 0;) cell = octantOf(cell, (i >> (3 * level)) & 7);
    if (!collect(narrowed(cell, everyPoint, everyOutside), kKeptLevels, keepGoing, parts[i])) stopped = true;
  });
  complete_ = !stopped;
  for (std::vector<Node>& part : parts) std::move(part.begin(), part.end(), std::back_inserter(kept_));
  for (const Node& node : kept_) keptOctants_.push_back(octantsOf(node.cell.center, half_));
}

bool CenterSearch::collect(const Node& node, int levels, const KeepGoing& keepGoing, std::vector<Node>& out) const {
  if (!keepGoing()) return false;
  if (node.points.empty()) return true;
  if (levels == 0) {
    out.push_back(node);
    return true;
  }
  for (int octant = 0; octant < 8; ++octant) {
    const Node part = narrowed(octantOf(node.cell, octant), node.points, node.outside);
    if (!collect(part, levels - 1, keepGoing, out)) return false;
  }
  return true;
}

CenterSearch::Node CenterSearch::narrowed(const CenterCell& cell, std::span<const std::uint32_t> points,
                                          std::span<const std::uint32_t> outside, double* nearestSq) const {
  std::vector<Obstacle> obstacles;
  obstacles.reserve(outside.size());
  for (const std::uint32_t q : outside) {
    const Vec3d offset = outside_[q] - cell.center;
    obstacles.push_back({lengthSq(offset), offset, q});
  }
  std::sort(obstacles.begin(), obstacles.end(),
            [](const Obstacle& a, const Obstacle& b) { return a.sq != b.sq ? a.sq < b.sq : a.index < b.index; });
  if (nearestSq) *nearestSq = obstacles.empty() ? std::numeric_limits<double>::infinity() : obstacles.front().sq;
  Node node{cell, {}, {}, 0};
  double farthestSq = 0;
  for (const std::uint32_t p : points) {
    const Vec3d offset = points_[p] - cell.center;
    const double sq = lengthSq(offset), limit = sq - guard_;
    bool excluded = false;
    for (const Obstacle& q : obstacles) {
      if (q.sq >= limit) break;
      // The largest value of |q - c|^2 - |p - c|^2 over the cell is at one of its corners.
      const Vec3d apart = q.offset - offset;
      const double most = q.sq + 2 * cell.half * (std::abs(apart.x) + std::abs(apart.y) + std::abs(apart.z));
      if (most < limit) {
        excluded = true;
        break;
      }
    }
    if (excluded) continue;
    node.points.push_back(p);
    farthestSq = std::max(farthestSq, sq);
  }
  if (node.points.empty()) return node;
  // It is always safe to skip an outside point. Beyond this reach the skip loses nothing.
  node.reach = std::sqrt(farthestSq) + 2 * std::numbers::sqrt3 * cell.half;
  for (const Obstacle& q : obstacles) {
    if (q.sq > node.reach * node.reach) break;
    node.outside.push_back(q.index);
  }
  return node;
}

bool CenterSearch::addOutside(const Vec3d& point) {
  if (std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) > half_) return false;
  const auto index = static_cast<std::uint32_t>(outside_.size());
  outside_.push_back(point);
  for (Node& node : kept_) {
    if (distance(node.cell.center, point) <= node.reach) node.outside.push_back(index);
  }
  return true;
}

/// The search below one kept node.
struct CenterSearch::Descent {
  const CenterSearch& search;
  std::span<const std::uint64_t> weights;
  std::uint64_t most;
  double finest;
  const KeepGoing& keepGoing;
  std::vector<HeavyCell> found;
  bool stopped = false;
  int visits = 0;

  std::uint64_t loadOf(std::span<const std::uint32_t> points) const {
    std::uint64_t load = 0;
    for (const std::uint32_t p : points) load += weights[p];
    return load;
  }

  void visit(const CenterCell& cell, std::span<const std::uint32_t> points, std::span<const std::uint32_t> outside) {
    ++visits;
    stopped = stopped || !keepGoing();
    if (stopped) return;
    double nearestSq = 0;
    const Node node = search.narrowed(cell, points, outside, &nearestSq);
    const std::uint64_t load = loadOf(node.points);
    if (load <= most) return;
    std::uint64_t atCenter = 0;
    for (const std::uint32_t p : node.points) {
      if (lengthSq(search.points_[p] - cell.center) < nearestSq) atCenter += weights[p];
    }
    if (atCenter > most) return found.push_back({{cell.center, 0}, atCenter});
    // Once a cell is reported there is no proof, and the rest may be skipped.
    if (cell.half <= finest || found.size() >= kMaxFound || visits > kMaxVisits) return found.push_back({cell, load});
    for (int octant = 0; octant < 8 && found.size() < kMaxFound; ++octant)
      visit(octantOf(cell, octant), node.points, node.outside);
  }
};

std::optional<std::vector<HeavyCell>> CenterSearch::heavierThan(std::span<const std::uint64_t> weights,
                                                                std::uint64_t most, double finest,
                                                                const KeepGoing& keepGoing) const {
  std::vector<std::vector<HeavyCell>> parts(kept_.size());
  std::atomic<bool> stopped = !complete_;
  tbb::parallel_for(std::size_t{0}, kept_.size(), [&](std::size_t i) {
    if (stopped) return;
    std::vector<std::uint32_t> weighty;
    for (const std::uint32_t p : kept_[i].points) {
      if (weights[p] > 0) weighty.push_back(p);
    }
    Descent descent{*this, weights, most, finest, keepGoing, {}, false, 0};
    if (descent.loadOf(weighty) > most) descent.visit(kept_[i].cell, weighty, kept_[i].outside);
    if (descent.stopped) stopped = true;
    parts[i] = std::move(descent.found);
  });
  if (stopped) return std::nullopt;
  std::vector<HeavyCell> all;
  for (const std::vector<HeavyCell>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

const CenterSearch::Node* CenterSearch::nodeAt(const Vec3d& center) const {
  if (std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) > half_) return nullptr;
  const std::uint32_t octants = octantsOf(center, half_);
  const auto it = std::lower_bound(keptOctants_.begin(), keptOctants_.end(), octants);
  if (it == keptOctants_.end() || *it != octants) return nullptr;
  return &kept_[static_cast<std::size_t>(it - keptOctants_.begin())];
}

std::vector<std::uint32_t> CenterSearch::pointsOf(const CenterCell& cell) const {
  const Node* node = nodeAt(cell.center);
  if (!node) return {};
  return narrowed(cell, node->points, node->outside).points;
}

Vec3d CenterSearch::grown(const Vec3d& center) const {
  const auto nearest = std::min_element(outside_.begin(), outside_.end(), [&](const Vec3d& a, const Vec3d& b) {
    return lengthSq(a - center) < lengthSq(b - center);
  });
  if (nearest == outside_.end()) return center;
  const Vec3d away = normalized(center - *nearest);
  // Solves |q - c - t u| = r + t, where r is the distance of the nearest: t = (|q - c|^2 - r^2) / (2 (r + (q - c) u)).
  const double radius = distance(center, *nearest);
  double step = std::numeric_limits<double>::infinity();
  for (const Vec3d& q : outside_) {
    const double toward = radius + dot(q - center, away);
    if (toward > 1e-9 * radius) step = std::min(step, (lengthSq(q - center) - radius * radius) / (2 * toward));
  }
  return std::isfinite(step) ? center + away * step : center;
}

}  // namespace cairn::builder

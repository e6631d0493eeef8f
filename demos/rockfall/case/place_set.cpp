// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/place_set.h"

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxPieces = 1000000;

MapPoint pointBetween(const MapPoint& a, const MapPoint& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// An edge of an area, upward.
struct Edge {
  MapPoint low, high;

  double xAt(double y) const { return low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]); }
};

void addEdges(const Polygon& ring, std::vector<Edge>& edges) {
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    if (ring[i][1] == ring[last][1]) continue;
    edges.push_back(ring[i][1] < ring[last][1] ? Edge{ring[i], ring[last]} : Edge{ring[last], ring[i]});
  }
}

}  // namespace

void PlaceSet::add(const Piece& piece, double weight) {
  pieces_.push_back(piece);
  upTo_.push_back((upTo_.empty() ? 0 : upTo_.back()) + weight);
}

void PlaceSet::addPoint(const MapPoint& point) {
  add({point, point, point, point}, 1);
}

void PlaceSet::addLine(const Polyline& line) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
    if (length > 0) add({line[i - 1], line[i - 1], line[i], line[i]}, length);
  }
}

bool PlaceSet::addArea(const Area& area) {
  std::vector<Edge> edges;
  addEdges(area.outline, edges);
  for (const Polygon& hole : area.holes) addEdges(hole, edges);
  std::ranges::sort(edges, {}, [](const Edge& edge) { return edge.low[1]; });
  std::vector<double> heights;
  for (const Edge& edge : edges) heights.insert(heights.end(), {edge.low[1], edge.high[1]});
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::vector<Edge> open;  // those that pass the strip between two heights
  std::size_t next = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double low = heights[i - 1], high = heights[i], middle = low + (high - low) / 2;
    std::erase_if(open, [&](const Edge& edge) { return edge.high[1] <= low; });
    while (next < edges.size() && edges[next].low[1] <= low) open.push_back(edges[next++]);
    std::ranges::sort(open, {}, [&](const Edge& edge) { return edge.xAt(middle); });
    // By the even-odd rule every second gap is inside.
    if (pieces_.size() + open.size() / 2 > kMaxPieces) return false;
    for (std::size_t e = 1; e < open.size(); e += 2) {
      const Piece piece{MapPoint{open[e - 1].xAt(low), low},
                        {open[e].xAt(low), low},
                        {open[e - 1].xAt(high), high},
                        {open[e].xAt(high), high}};
      const double size = (high - low) * (piece[1][0] - piece[0][0] + piece[3][0] - piece[2][0]) / 2;
      if (size > 0) add(piece, size);
    }
  }
  return true;
}

void PlaceSet::moveBy(const MapPoint& by) {
  for (Piece& piece : pieces_)
    for (MapPoint& corner : piece) corner = {corner[0] + by[0], corner[1] + by[1]};
}

MapPoint PlaceSet::at(double which, double along, double across) const {
  const auto found = std::ranges::upper_bound(upTo_, which * upTo_.back());
  return in(std::min<std::size_t>(static_cast<std::size_t>(found - upTo_.begin()), pieces_.size() - 1), along, across);
}

MapPoint PlaceSet::in(std::size_t index, double along, double across) const {
  const Piece& piece = pieces_[index];
  // The inverse of the share of a trapezoid below a height, in a form without division by a difference.
  const double low = piece[1][0] - piece[0][0], high = piece[3][0] - piece[2][0];
  const double root = std::sqrt(low * low + along * (high * high - low * low));
  const double up = low + root > 0 ? along * (low + high) / (low + root) : along;
  return pointBetween(pointBetween(piece[0], piece[2], up), pointBetween(piece[1], piece[3], up), across);
}

}  // namespace cairn::rockfall

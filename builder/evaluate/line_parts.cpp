// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/line_parts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cairn::builder {
namespace {

std::vector<Rectangle> shadowsOf(const TriangleMesh& mesh) {
  std::vector<Rectangle> shadows(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    shadows[t].lower = {std::min({c[0].x, c[1].x, c[2].x}), std::min({c[0].y, c[1].y, c[2].y})};
    shadows[t].upper = {std::max({c[0].x, c[1].x, c[2].x}), std::max({c[0].y, c[1].y, c[2].y})};
  }
  return shadows;
}

std::vector<Rectangle> shadowsOf(const std::vector<CutBall>& balls) {
  std::vector<Rectangle> shadows;
  for (const CutBall& b : balls)
    shadows.push_back({{b.center.x - b.radius, b.center.y - b.radius}, {b.center.x + b.radius, b.center.y + b.radius}});
  return shadows;
}

/// Tests whether the ray from (x, y) towards +x meets the projected edge. Returns the edge's direction there: 1 up, -1
/// down, 0 without a meeting. The computation starts from the same corner for both triangles.
int edgeCrossing(const TriangleMesh& mesh, std::uint32_t from, std::uint32_t to, double x, double y) {
  const Vec3d &a = mesh.vertices[from], &b = mesh.vertices[to];
  if ((a.y <= y) == (b.y <= y)) return 0;
  const Vec3d &p = from < to ? a : b, &q = from < to ? b : a;
  const double side = (q.x - p.x) * (y - p.y) - (x - p.x) * (q.y - p.y);
  const bool right = q.y > p.y ? side > 0 : side < 0;
  return !right ? 0 : a.y <= y ? 1 : -1;
}

double heightAt(const std::array<Vec3d, 3>& c, double x, double y) {
  const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const double height = c[0].z - (normal.x * (x - c[0].x) + normal.y * (y - c[0].y)) / normal.z;
  // Rounding may move a steep triangle's plane far off, but not the triangle. A NaN becomes its lowest corner.
  const auto [low, high] = std::minmax({c[0].z, c[1].z, c[2].z});
  return height > low ? std::min(height, high) : low;
}

}  // namespace

SolidLines::SolidLines(const TriangleMesh& mesh) : mesh_(mesh), buckets_(shadowsOf(mesh)) {}

SolidLines::Crossing SolidLines::crossingOf(std::uint32_t triangle, double x, double y) const {
  const Triangle& t = mesh_.triangles[triangle];
  int turns = 0;  // of the projected triangle around (x, y): 1 when it faces up
  for (int i = 0; i < 3; ++i) turns += edgeCrossing(mesh_, t[i], t[(i + 1) % 3], x, y);
  if (turns == 0) return {};
  return {heightAt(mesh_.corners(triangle), x, y), -turns};
}

void SolidLines::partsAt(double x, double y, LineParts& out) const {
  out.clear();
  std::vector<Crossing> crossings;
  for (const std::uint32_t triangle : buckets_.at(x, y))
    if (const Crossing c = crossingOf(triangle, x, y); c.entries != 0) crossings.push_back(c);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
  int winding = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    winding += crossings[i].entries;
    if (winding <= 0) continue;
    assert(i + 1 < crossings.size());
    if (!out.empty() && out.back().end == crossings[i].z)
      out.back().end = crossings[i + 1].z;
    else
      out.push_back({crossings[i].z, crossings[i + 1].z});
  }
}

BallLines::BallLines(const std::vector<CutBall>& balls) : balls_(balls), buckets_(shadowsOf(balls)) {}

void BallLines::partsAt(double x, double y, LineParts& out) const {
  out.clear();
  for (const std::uint32_t index : buckets_.at(x, y)) {
    const CutBall& ball = balls_[index];
    const double dx = x - ball.center.x, dy = y - ball.center.y;
    const double halfSq = ball.radius * ball.radius - dx * dx - dy * dy;
    if (halfSq <= 0) continue;
    const double half = std::sqrt(halfSq);
    out.push_back({ball.center.z - half, ball.center.z + half});
  }
  if (out.empty()) return;
  std::sort(out.begin(), out.end(), [](const LinePart& a, const LinePart& b) { return a.begin < b.begin; });
  std::size_t last = 0;
  for (const LinePart& part : out) {
    if (part.begin <= out[last].end)
      out[last].end = std::max(out[last].end, part.end);
    else
      out[++last] = part;
  }
  out.resize(last + 1);
}

void subtract(const LineParts& from, const LineParts& what, LineParts& out) {
  out.clear();
  auto hole = what.begin();
  for (const LinePart& part : from) {
    double begin = part.begin;
    while (hole != what.end() && hole->end <= begin) ++hole;
    for (auto h = hole; h != what.end() && h->begin < part.end; ++h) {
      if (h->begin > begin) out.push_back({begin, h->begin});
      begin = std::max(begin, h->end);
    }
    if (begin < part.end) out.push_back({begin, part.end});
  }
}

}  // namespace cairn::builder

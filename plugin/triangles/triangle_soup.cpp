// SPDX-License-Identifier: Zlib
#include "triangles/triangle_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cairn::bullet {

namespace {

bool before(const TriangleSoup::Source& x, const TriangleSoup::Source& y) {
  return std::tie(x.part, x.index) < std::tie(y.part, y.index);
}

auto coordinates(const TriangleSoup::Source& s) {
  const auto& [a, b, c] = s.corners;
  return std::array{a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()};
}

// A user's own shape may number its triangles freely, or not at all.
bool beforeInSoup(const TriangleSoup::Source& x, const TriangleSoup::Source& y) {
  if (before(x, y) || before(y, x)) return before(x, y);
  return coordinates(x) < coordinates(y);
}

class Gatherer final : public btTriangleCallback {
 public:
  explicit Gatherer(std::vector<TriangleSoup::Source>& found) : found_(found) {}
  void processTriangle(btVector3* triangle, int partId, int triangleIndex) override {
    found_.push_back({partId, triangleIndex, {triangle[0], triangle[1], triangle[2]}});
  }

 private:
  std::vector<TriangleSoup::Source>& found_;
};

}  // namespace

void TriangleSoup::gather(const btConcaveShape& shape, const btVector3& lower, const btVector3& upper) {
  triangles_.clear();
  Gatherer gatherer(triangles_);
  shape.processAllTriangles(&gatherer, lower, upper);
  std::sort(triangles_.begin(), triangles_.end(), beforeInSoup);
  lower_ = lower;
  upper_ = upper;
}

bool TriangleSoup::covers(const btVector3& lower, const btVector3& upper) const {
  for (int axis = 0; axis < 3; ++axis)
    if (lower[axis] < lower_[axis] || upper[axis] > upper_[axis]) return false;
  return true;
}

int TriangleSoup::find(const Source& wanted) const {
  const auto [first, last] = std::equal_range(triangles_.begin(), triangles_.end(), wanted, before);
  auto it = first;
  if (last - first > 1)
    it = std::find_if(first, last, [&](const Source& s) { return coordinates(s) == coordinates(wanted); });
  return it == last ? -1 : static_cast<int>(it - triangles_.begin());
}

void SoupObstacle::clear(float margin) {
  elements_.clear();
  margin_ = margin;
}

void SoupObstacle::add(const Triangle& triangle) {
  const Vec3 normal = triangle.normal();
  elements_.push_back({triangle, normal, dot(normal, triangle.a)});
}

std::uint32_t SoupObstacle::touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const {
  const Element& e = elements_[element];
  std::uint32_t hits = 0;
  for (std::uint32_t i = 0; i < std::min(familySize, kFamilyWidth); ++i) {
    const Vec3 p(family.x[i], family.y[i], family.z[i]);
    const float maxSeparation = family.radius[i] + margin_;
    if (std::abs(dot(e.normal, p) - e.offset) > maxSeparation) continue;
    hits |= static_cast<std::uint32_t>(lengthSq(p - nearestOnTriangle(e.triangle, p).point) <=
                                       maxSeparation * maxSeparation)
            << i;
  }
  return hits;
}

}  // namespace cairn::bullet

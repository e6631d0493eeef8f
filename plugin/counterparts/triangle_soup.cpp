// SPDX-License-Identifier: Zlib
#include "counterparts/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn::bullet {

namespace {

bool before(const TriangleSoup::Source& x, const TriangleSoup::Source& y) {
  return std::tie(x.part, x.index) < std::tie(y.part, y.index);
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
  std::sort(triangles_.begin(), triangles_.end(), before);
  lower_ = lower;
  upper_ = upper;
}

bool TriangleSoup::covers(const btVector3& lower, const btVector3& upper) const {
  for (int axis = 0; axis < 3; ++axis)
    if (lower[axis] < lower_[axis] || upper[axis] > upper_[axis]) return false;
  return true;
}

int TriangleSoup::find(int part, int index) const {
  Source wanted;
  wanted.part = part;
  wanted.index = index;
  const auto it = std::lower_bound(triangles_.begin(), triangles_.end(), wanted, before);
  const bool found = it != triangles_.end() && it->part == part && it->index == index;
  return found ? static_cast<int>(it - triangles_.begin()) : -1;
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
    const float reach = family.radius[i] + margin_;
    if (std::abs(dot(e.normal, p) - e.offset) > reach) continue;
    hits |= static_cast<std::uint32_t>(lengthSq(p - nearestOnTriangle(e.triangle, p).point) <= reach * reach) << i;
  }
  return hits;
}

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#include "refit_binding.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "cairn/core/surface_depth.h"

namespace cairn {

namespace {

Vec3d cornerOf(const SphereTree& tree, std::uint32_t triangle, std::size_t k) {
  return Vec3d(tree.vertices()[tree.triangles()[triangle][k]]);
}

class Binder {
 public:
  explicit Binder(const SphereTree& tree) : tree_(tree) {
    for (std::uint32_t v = 0; v < tree.vertices().size(); ++v) {
      const Vec3& p = tree.vertices()[v];
      vertexAt_.try_emplace({p.x, p.y, p.z}, v);
    }
  }

  RefitBinding run() {
    out_.support.assign(tree_.data().supportPoints.size(), SurfaceEdge::kNone);  // stays for points of no node
    out_.faceOfNormal.assign(tree_.data().faceNormals.size(), 0);
    const std::vector<std::vector<FixedPlace>> corners = cornersOfParts(tree_);
    for (std::uint32_t record = 0; record < tree_.nodeCount(); ++record) addPlaces(record, corners[record]);
    out_.nodes.push_back({});
    out_.nodes.back().firstPlace = static_cast<std::uint32_t>(out_.placesOfNodes.size());
    out_.places.resize(tree_.vertices().size() + out_.fixed.size());
    out_.move(tree_, tree_.vertices(), out_.places);
    measureTriangles();
    for (std::uint32_t record = 0; record < tree_.nodeCount(); ++record) measureNode(record);
    return std::move(out_);
  }

 private:
  void addPlaces(std::uint32_t record, std::span<const FixedPlace> corners) {
    const NodeData& n = tree_.data().nodes[record];
    std::vector<std::uint32_t> places;
    for (const FixedPlace& corner : corners) places.push_back(numberOf(corner));
    for (std::uint32_t i = n.firstSupport; i < n.firstSupport + n.supportCount; ++i) {
      if (out_.support[i] == SurfaceEdge::kNone) out_.support[i] = placeOfSupport(i, tree_.nodeAt(record));
      places.push_back(out_.support[i]);
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    out_.nodes.push_back({});
    out_.nodes.back().firstPlace = static_cast<std::uint32_t>(out_.placesOfNodes.size());
    out_.placesOfNodes.insert(out_.placesOfNodes.end(), places.begin(), places.end());
  }

  std::uint32_t numberOf(const FixedPlace& place) {
    const auto& triangle = tree_.triangles()[place.triangle];
    if (place.b == 0 && place.c == 0) return triangle[0];
    if (place.b == 1 && place.c == 0) return triangle[1];
    if (place.b == 0 && place.c == 1) return triangle[2];
    const auto next = static_cast<std::uint32_t>(tree_.vertices().size() + out_.fixed.size());
    const auto [it, isNew] = fixedAt_.try_emplace({place.triangle, place.b, place.c}, next);
    if (isNew) out_.fixed.push_back(place);
    return it->second;
  }

  // Most are vertices. The others lie where a region's border crosses a triangle.
  std::uint32_t placeOfSupport(std::uint32_t index, NodeId node) {
    const Vec3& p = tree_.data().supportPoints[index];
    if (const auto it = vertexAt_.find({p.x, p.y, p.z}); it != vertexAt_.end()) return it->second;
    FixedPlace best;
    double leastSq = std::numeric_limits<double>::infinity();
    for (const std::uint32_t triangle : tree_.regionTriangles(node)) {
      const FixedPlace place = placeOn(tree_, triangle, Vec3d(p));
      if (const double sq = lengthSq(whereIs(tree_, place) - Vec3d(p)); sq < leastSq) {
        leastSq = sq;
        best = place;
      }
    }
    return numberOf(best);
  }

  void measureTriangles() {
    for (std::uint32_t t = 0; t < tree_.triangles().size(); ++t) {
      const Vec3d a = cornerOf(tree_, t, 0);
      out_.areas.push_back(length(cross(cornerOf(tree_, t, 1) - a, cornerOf(tree_, t, 2) - a)) / 2);
    }
  }

  void measureNode(std::uint32_t record) {
    RefitBinding::Node& node = out_.nodes[record];
    const NodeData& n = tree_.data().nodes[record];
    const std::span<const std::uint32_t> places = out_.placesOf(record);
    for (const std::uint32_t place : places) node.middle += out_.places[place];
    node.middle = node.middle / double(places.size());
    double spreadSq = 0, area = 0;
    for (const std::uint32_t place : places) spreadSq += lengthSq(out_.places[place] - node.middle);
    const std::span<const std::uint32_t> region = tree_.regionTriangles(tree_.nodeAt(record));
    for (const std::uint32_t triangle : region) area += out_.areas[triangle];
    node.weightOfNormals = area > 0 ? spreadSq / area : 0;
    node.nearest = search_.at(tree_.surfaceView(), n.center, region.front()).triangle;
    const std::span<const SurfaceFace> faces = tree_.surface().features.faces();
    for (std::uint32_t i = n.firstNormal; i < n.firstNormal + n.normalCount; ++i)
      out_.faceOfNormal[i] = *std::ranges::max_element(
          region, {}, [&](std::uint32_t triangle) { return dot(faces[triangle].normal, tree_.data().faceNormals[i]); });
  }

  const SphereTree& tree_;
  RefitBinding out_;
  SurfaceDepthSearch search_;
  std::map<std::tuple<float, float, float>, std::uint32_t> vertexAt_;
  std::map<std::tuple<std::uint32_t, double, double>, std::uint32_t> fixedAt_;
};

}  // namespace

// In the plane of the triangle, moved in from beside it.
FixedPlace placeOn(const SphereTree& tree, std::uint32_t triangle, const Vec3d& point) {
  const Vec3d a = cornerOf(tree, triangle, 0), p = point - a;
  const Vec3d u = cornerOf(tree, triangle, 1) - a, v = cornerOf(tree, triangle, 2) - a, area = cross(u, v);
  const double norm = lengthSq(area);
  if (!(norm > 0)) return {triangle, 0, 0};
  const double b = std::max(0.0, dot(cross(p, v), area) / norm), c = std::max(0.0, dot(cross(u, p), area) / norm);
  const double sum = std::max(1.0, b + c);
  return {triangle, b / sum, c / sum};
}

Vec3d whereIs(const SphereTree& tree, const FixedPlace& place) {
  const Vec3d a = cornerOf(tree, place.triangle, 0);
  return a + (cornerOf(tree, place.triangle, 1) - a) * place.b + (cornerOf(tree, place.triangle, 2) - a) * place.c;
}

void RefitBinding::move(const SphereTree& tree, std::span<const Vec3> vertices, std::span<Vec3d> out) const {
  for (std::size_t v = 0; v < vertices.size(); ++v) out[v] = Vec3d(vertices[v]);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const auto& [a, b, c] = tree.triangles()[fixed[i].triangle];
    out[vertices.size() + i] = out[a] + (out[b] - out[a]) * fixed[i].b + (out[c] - out[a]) * fixed[i].c;
  }
}

RefitBinding bindTree(const SphereTree& tree) {
  return Binder(tree).run();
}

}  // namespace cairn

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/pseudonormals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "surface/edges.h"

namespace cairn::builder {
namespace {

/// If the sum of two triangles' unit normals is shorter than this, the normals are opposite to within a degree.
constexpr double kSharp = 0x1p-6;

double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

Pseudonormals::Pseudonormals(const TriangleMesh& mesh)
    : faces_(mesh.triangles.size()), vertices_(mesh.vertices.size()), edges_(mesh.triangles.size()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    faces_[t] = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (int i = 0; i < 3; ++i) {
      const Vec3d& here = corners[i];
      const double angle = angleBetween(corners[(i + 1) % 3] - here, corners[(i + 2) % 3] - here);
      vertices_[mesh.triangles[t][i]] += faces_[t] * angle;
    }
  }
  const std::vector<HalfEdge> halfEdges = sortedHalfEdges(mesh);
  for (auto first = halfEdges.begin(); first != halfEdges.end();) {
    const auto last = std::find_if(first, halfEdges.end(), [&](const HalfEdge& h) { return !h.sameEdge(*first); });
    Vec3d sum;
    for (auto h = first; h != last; ++h) sum += faces_[h->triangle];
    for (auto h = first; h != last; ++h) edges_[h->triangle][h->side] = sum;
    first = last;
  }
  findSharpEdges(mesh);
}

void Pseudonormals::findSharpEdges(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> corners(mesh.vertices.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      if (lengthSq(edges_[t][i]) < kSharp * kSharp)
        corners[mesh.triangles[t][i]] = corners[mesh.triangles[t][(i + 1) % 3]] = 1;
  sharp_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) sharp_.push_back(corners[t[0]] | corners[t[1]] | corners[t[2]]);
}

const Vec3d& Pseudonormals::at(const TriangleMesh& mesh, std::uint32_t triangle, Feature feature) const {
  switch (feature) {
    case Feature::corner0:
    case Feature::corner1:
    case Feature::corner2:
      return vertices_[mesh.triangles[triangle][static_cast<int>(feature)]];
    case Feature::edge0:
    case Feature::edge1:
    case Feature::edge2:
      return edges_[triangle][static_cast<int>(feature) - static_cast<int>(Feature::edge0)];
    case Feature::face:
      break;
  }
  return faces_[triangle];
}

}  // namespace cairn::builder

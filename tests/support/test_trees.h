// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "cairn/core/sphere_tree.h"
#include "random_tree.h"
#include "test_solids.h"

namespace cairn::test {

/// Exact integrals over a closed mesh, by signed tetrahedra from the origin.
inline MassProperties massOf(const Solid& solid) {
  MassProperties m;
  Mat3d second{{Vec3d(), Vec3d(), Vec3d()}};  // integral of p p^T
  for (const auto& t : solid.triangles) {
    const Vec3d a = solid.vertices[t[0]], b = solid.vertices[t[1]], c = solid.vertices[t[2]];
    const double volume = dot(a, cross(b, c)) / 6;
    const Vec3d sum = a + b + c;
    m.volume += volume;
    m.centerOfMass += sum * (volume / 4);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        second(i, j) += volume / 20 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
  }
  m.centerOfMass = m.centerOfMass / m.volume;
  const Vec3d g = m.centerOfMass;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second(i, j) = second(i, j) / m.volume - g[i] * g[j];
  const double trace = second(0, 0) + second(1, 1) + second(2, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m.inertia(i, j) = (i == j ? trace : 0) - second(i, j);
  return m;
}

/// Fills in the principal frame of a solid whose products of inertia vanish: all of ours are symmetric about their
/// axes.
inline void setPrincipalFrame(MassProperties& m) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return m.inertia(i, i) < m.inertia(j, j); });
  Vec3d axes[3];
  for (int k = 0; k < 3; ++k) {
    axes[k][order[static_cast<std::size_t>(k)]] = 1;
    m.principalMoments[k] = m.inertia(order[static_cast<std::size_t>(k)], order[static_cast<std::size_t>(k)]);
  }
  axes[2] = cross(axes[0], axes[1]);
  m.principalAxes = transpose(Mat3d{{axes[0], axes[1], axes[2]}});
}

/// A valid sphere-tree over a solid without any of the builder's methods: triangles are halved along the longest axis
/// three times a level, every node is a ball around the corners of its triangles, and its certified error is the
/// trivial bound.
class PlainTreeBuilder {
 public:
  PlainTreeBuilder(const Solid& solid, std::uint32_t trianglesPerLeaf) : perLeaf_(trianglesPerLeaf) {
    data_.mass = massOf(solid);
    setPrincipalFrame(data_.mass);
    data_.origin = Vec3d(Vec3(data_.mass.centerOfMass));
    for (const Vec3d& v : solid.vertices) data_.vertices.push_back(Vec3(v - data_.origin));
    data_.triangles = solid.triangles;
    data_.regionTriangles.resize(solid.triangles.size());
    std::iota(data_.regionTriangles.begin(), data_.regionTriangles.end(), 0U);
    data_.info.meshName = "generated";
    data_.info.method = "plain";
  }

  SphereTreeData build() {
    struct Waiting {
      std::uint32_t parent, first, count;
    };
    std::vector<Waiting> queue{{0, 0, static_cast<std::uint32_t>(data_.triangles.size())}};
    for (std::uint32_t self = 0; self < queue.size(); ++self) {
      const Waiting w = queue[self];
      addNode(w.parent, w.first, w.count);
      if (w.count <= perLeaf_) continue;
      std::vector<std::pair<std::uint32_t, std::uint32_t>> parts{{w.first, w.count}};
      for (int halving = 0; halving < 3; ++halving) parts = halve(parts);
      for (const auto& [first, count] : parts) queue.push_back({self, first, count});
    }
    return std::move(data_);
  }

 private:
  Vec3 corner(std::uint32_t slot, std::uint32_t k) const {
    return data_.vertices[data_.triangles[data_.regionTriangles[slot]][k]];
  }
  Vec3 middle(std::uint32_t triangle) const {
    const auto& t = data_.triangles[triangle];
    return (data_.vertices[t[0]] + data_.vertices[t[1]] + data_.vertices[t[2]]) / 3.0F;
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> halve(
      const std::vector<std::pair<std::uint32_t, std::uint32_t>>& parts) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> halves;
    for (const auto& [first, count] : parts) {
      if (count <= perLeaf_) {
        halves.push_back({first, count});
        continue;
      }
      const auto begin = data_.regionTriangles.begin() + first, end = begin + count;
      Vec3 lower = middle(*begin), upper = lower;
      for (auto it = begin; it != end; ++it)
        for (int axis = 0; axis < 3; ++axis) {
          lower[axis] = std::min(lower[axis], middle(*it)[axis]);
          upper[axis] = std::max(upper[axis], middle(*it)[axis]);
        }
      const Vec3 extent = upper - lower;
      const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
      std::sort(begin, end, [&](std::uint32_t s, std::uint32_t t) {
        const float a = middle(s)[axis], b = middle(t)[axis];
        return a != b ? a < b : s < t;
      });
      halves.push_back({first, count / 2});
      halves.push_back({first + count / 2, count - count / 2});
    }
    return halves;
  }

  std::vector<Vec3> corners(std::uint32_t first, std::uint32_t count) const {
    std::vector<Vec3> points;
    for (std::uint32_t slot = first; slot < first + count; ++slot)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (std::find(points.begin(), points.end(), corner(slot, k)) == points.end()) points.push_back(corner(slot, k));
    return points;
  }

  void addNode(std::uint32_t parent, std::uint32_t first, std::uint32_t count) {
    const std::vector<Vec3> points = corners(first, count);
    Vec3 lower = points[0], upper = points[0];
    for (const Vec3& p : points)
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], p[axis]);
        upper[axis] = std::max(upper[axis], p[axis]);
      }
    NodeData n;
    n.center = (lower + upper) * 0.5F;
    float nearest = std::numeric_limits<float>::max();
    for (const Vec3& p : points) {
      n.radius = std::max(n.radius, distance(p, n.center));
      nearest = std::min(nearest, distance(p, n.center));
    }
    n.radius *= 1 + 1e-5F;
    n.error = n.radius + nearest;
    n.parent = parent;
    n.firstTriangle = first;
    n.triangleCount = count;
    addSupport(n, points);
    addNormals(n);
    data_.nodes.push_back(n);
  }

  // All corners of a leaf; of a larger region the extreme ones along directions spread over the sphere.
  void addSupport(NodeData& n, std::vector<Vec3> points) {
    if (points.size() > kMaxSupportPoints) {
      std::vector<Vec3> extreme;
      for (std::uint32_t i = 0; i < kMaxSupportPoints; ++i) {
        const float z = 1 - (2 * static_cast<float>(i) + 1) / kMaxSupportPoints;
        const float r = std::sqrt(1 - z * z), angle = 2.399963F * static_cast<float>(i);
        const Vec3 d{r * std::cos(angle), r * std::sin(angle), z};
        extreme.push_back(*std::max_element(points.begin(), points.end(),
                                            [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); }));
      }
      points = extreme;
    }
    n.firstSupport = static_cast<std::uint32_t>(data_.supportPoints.size());
    n.supportCount = static_cast<std::uint32_t>(points.size());
    data_.supportPoints.insert(data_.supportPoints.end(), points.begin(), points.end());
  }

  void addNormals(NodeData& n) {
    std::vector<Vec3> normals;
    Vec3 sum;
    for (std::uint32_t slot = n.firstTriangle; slot < n.firstTriangle + n.triangleCount; ++slot) {
      const Vec3 normal = normalized(cross(corner(slot, 1) - corner(slot, 0), corner(slot, 2) - corner(slot, 0)));
      normals.push_back(normal);
      sum += normal;
    }
    if (length(sum) > 1e-3F) {
      n.normalCone.axis = normalized(sum);
      n.normalCone.cosine = 1;
      for (const Vec3& normal : normals)
        n.normalCone.cosine = std::clamp(dot(normal, n.normalCone.axis), -1.0F, n.normalCone.cosine);
    }
    n.firstNormal = static_cast<std::uint32_t>(data_.faceNormals.size());
    for (const Vec3& normal : normals) {
      const auto own = data_.faceNormals.begin() + n.firstNormal;
      const bool isNew =
          std::none_of(own, data_.faceNormals.end(), [&](const Vec3& m) { return dot(m, normal) > 0.999F; });
      if (isNew && n.normalCount < kMaxFaceNormals) {
        data_.faceNormals.push_back(normal);
        ++n.normalCount;
      }
    }
  }

  SphereTreeData data_;
  std::uint32_t perLeaf_;
};

inline std::shared_ptr<const SphereTree> plainTree(const Solid& solid, std::uint32_t trianglesPerLeaf = 2) {
  Result<SphereTree> tree = SphereTree::create(PlainTreeBuilder(solid, trianglesPerLeaf).build());
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

/// The tree with its balls as bounds, and larger ones from elsewhere to answer.
inline std::shared_ptr<const SphereTree> withTwoSpheres(const SphereTree& tree, std::uint64_t seed) {
  SphereTreeData data = tree.data();
  std::mt19937_64 engine(seed);
  for (NodeData& n : data.nodes) {
    data.bounds.push_back({n.center, n.radius});
    const Vec3 shift = Vec3(randomPoint(engine)) * (0.2F * n.radius);
    n.center += shift;
    n.radius += length(shift) * 1.001F;
    n.error = 2 * n.radius;
  }
  Result<SphereTree> two = SphereTree::create(std::move(data));
  if (!two) throw std::runtime_error(two.error().message);
  return std::make_shared<const SphereTree>(std::move(two).value());
}

}  // namespace cairn::test

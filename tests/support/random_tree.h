// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "cairn/core/pose.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::test {

/// Uniform in [0, 1): the same on every platform, unlike std::uniform_real_distribution.
inline double uniform(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}
inline double uniform(std::mt19937_64& engine, double lower, double upper) {
  return lower + (upper - lower) * uniform(engine);
}
inline Vec3d randomPoint(std::mt19937_64& engine) {
  return {uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
}

inline Mat3d randomRotation(std::mt19937_64& engine) {
  Vec3d x = normalized(randomPoint(engine) + Vec3d(1e-3, 0, 0));
  Vec3d y = randomPoint(engine);
  y = normalized(y - x * dot(x, y));
  return transpose(Mat3d{{x, y, cross(x, y)}});
}

/// A sphere-tree over a cloud of points, each of which belongs to one leaf: balls of all shapes of tree, no geometry.
struct RandomTree {
  SphereTreeData data;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> leafOfPoint;  ///< breadth-first record number of the leaf that answers for the point
};

namespace detail {

struct Cluster {
  std::uint32_t parent, level;
  std::vector<std::uint32_t> points;
};

inline NodeData ballAround(const std::vector<Vec3>& all, const Cluster& cluster) {
  NodeData n;
  Vec3d sum;
  for (const std::uint32_t i : cluster.points) sum += Vec3d(all[i]);
  n.center = Vec3(sum / static_cast<double>(cluster.points.size()));
  for (const std::uint32_t i : cluster.points) n.radius = std::max(n.radius, distance(all[i], n.center));
  n.radius = n.radius * 1.0001F + 1e-4F;
  n.error = n.radius;
  n.parent = cluster.parent;
  n.supportCount = 1;
  n.triangleCount = 4;
  return n;
}

// Splits by distance to randomly chosen seeds, so that siblings overlap as real ones do.
inline std::vector<Cluster> split(std::mt19937_64& engine, const std::vector<Vec3>& all, const Cluster& cluster,
                                  std::uint32_t self, std::uint32_t count) {
  std::vector<Cluster> parts(count, Cluster{self, cluster.level + 1, {}});
  std::vector<Vec3> seeds;
  for (std::uint32_t k = 0; k < count; ++k) seeds.push_back(all[cluster.points[engine() % cluster.points.size()]]);
  for (const std::uint32_t i : cluster.points) {
    const auto nearest = std::min_element(seeds.begin(), seeds.end(), [&](const Vec3& a, const Vec3& b) {
      return distance(a, all[i]) < distance(b, all[i]);
    });
    parts[static_cast<std::size_t>(nearest - seeds.begin())].points.push_back(i);
  }
  std::erase_if(parts, [](const Cluster& c) { return c.points.empty(); });
  return parts;
}

// A tetrahedron in the root's ball stands for the mesh: of a third of its radius, of moments that a solid can have.
// Precondition: the nodes are there.
inline void addTetrahedron(SphereTreeData& data) {
  const NodeData& root = data.nodes[0];
  const float edge = root.radius / 3;
  data.vertices = {{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}};
  for (Vec3& v : data.vertices) v += root.center;
  data.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  data.regionTriangles = {0, 1, 2, 3};
  data.mass.volume = double(edge) * double(edge) * double(edge) / 6;
  data.mass.centerOfMass = Vec3d(root.center) + Vec3d(1, 1, 1) * (double(edge) / 4);
  const double moment = double(edge) * double(edge) / 10;
  data.mass.principalMoments = {moment, moment, moment};
  data.mass.inertia = {{Vec3d(moment, 0, 0), Vec3d(0, moment, 0), Vec3d(0, 0, moment)}};
  data.mass.principalAxes = {{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}};
}

}  // namespace detail

inline RandomTree randomTree(std::uint64_t seed, std::uint32_t pointCount = 300, std::uint32_t depth = 3) {
  std::mt19937_64 engine(seed);
  RandomTree tree;
  for (std::uint32_t i = 0; i < pointCount; ++i) tree.points.push_back(Vec3(randomPoint(engine)));
  tree.leafOfPoint.resize(pointCount);

  std::vector<detail::Cluster> queue(1);
  for (std::uint32_t i = 0; i < pointCount; ++i) queue[0].points.push_back(i);
  for (std::uint32_t next = 0; next < queue.size(); ++next) {
    const detail::Cluster cluster = queue[next];
    tree.data.nodes.push_back(detail::ballAround(tree.points, cluster));
    tree.data.nodes.back().firstSupport = next;
    tree.data.supportPoints.push_back(tree.data.nodes.back().center);
    const auto count = static_cast<std::uint32_t>(2 + engine() % 7);
    const bool leaf = cluster.level == depth || cluster.points.size() < count;
    if (leaf) {
      for (const std::uint32_t i : cluster.points) tree.leafOfPoint[i] = next;
      continue;
    }
    for (detail::Cluster& part : detail::split(engine, tree.points, cluster, next, count)) queue.push_back(part);
  }
  detail::addTetrahedron(tree.data);
  return tree;
}

/// Gives each node a second ball that holds its points, from elsewhere, as its bound.
inline void addBounds(RandomTree& tree, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Sphere>& bounds = tree.data.bounds;
  for (const NodeData& node : tree.data.nodes)
    bounds.push_back({node.center + Vec3(randomPoint(engine)) * (0.4F * node.radius), 0});
  for (std::size_t i = 0; i < tree.points.size(); ++i)
    for (std::uint32_t record = tree.leafOfPoint[i];; record = tree.data.nodes[record].parent) {
      Sphere& bound = bounds[record];
      bound.radius = std::max(bound.radius, distance(tree.points[i], bound.center));
      if (record == 0) break;
    }
  for (Sphere& bound : bounds) bound.radius = bound.radius * 1.0001F + 1e-4F;
}

/// The same tree in another unit.
inline void scaleTree(SphereTreeData& data, float factor) {
  for (Sphere& bound : data.bounds) bound = {bound.center * factor, bound.radius * factor};
  for (NodeData& node : data.nodes) {
    node.center = node.center * factor;
    node.radius *= factor;
    node.error *= factor;
  }
  for (Vec3& v : data.vertices) v = v * factor;
  for (Vec3& v : data.supportPoints) v = v * factor;
  const auto f = double(factor);
  MassProperties& m = data.mass;
  m.volume *= f * f * f;
  m.centerOfMass = m.centerOfMass * f;
  m.principalMoments = m.principalMoments * (f * f);
  for (Vec3d& row : m.inertia.rows) row = row * (f * f);
}

inline Pose randomPose(std::mt19937_64& engine, double spread) {
  return {randomRotation(engine), randomPoint(engine) * spread, uniform(engine, 0.5, 2)};
}

}  // namespace cairn::test

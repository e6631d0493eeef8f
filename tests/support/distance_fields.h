// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::test {

/// A signed distance by formula, negative inside.
using Distance = std::function<double(const Vec3d&)>;

/// Distance from an axis-parallel box around the origin, exact inside and outside.
inline Distance boxDistance(const Vec3d& halfExtents) {
  return [halfExtents](const Vec3d& p) {
    const Vec3d q{std::abs(p.x) - halfExtents.x, std::abs(p.y) - halfExtents.y, std::abs(p.z) - halfExtents.z};
    const double out = std::hypot(std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0));
    return out + std::min(std::max({q.x, q.y, q.z}), 0.0);
  };
}

inline Distance ballDistance(double radius) {
  return [radius](const Vec3d& p) { return length(p) - radius; };
}

/// Where a field is known, and how finely.
struct FieldGrid {
  Vec3d lower, upper;
  std::array<std::uint32_t, 3> cells;
  /// Cells for which this holds are left out, as generators do far from the surface: the field says nothing there.
  std::function<bool(const Vec3d& center)> isLeftOut = {};
};

/// The bytes that `btSdfCollisionShape::initializeSDF` reads: numbers one after the other, as they are in memory. Every
/// cell has 32 nodes of its own: its corners, and two on each edge at thirds; the field between them is cubic.
class FieldFile {
 public:
  FieldFile(const FieldGrid& grid, const Distance& distance) {
    const std::uint64_t cells = std::uint64_t{grid.cells[0]} * grid.cells[1] * grid.cells[2];
    const Vec3d extent = grid.upper - grid.lower;
    const Vec3d cell{extent.x / grid.cells[0], extent.y / grid.cells[1], extent.z / grid.cells[2]};
    put(grid.lower);
    put(grid.upper);
    for (const std::uint32_t count : grid.cells) put(count);
    put(cell);
    put(Vec3d{1 / cell.x, 1 / cell.y, 1 / cell.z});
    put(cells);
    put(std::uint64_t{1});  // fields, and the same number before each of the lists
    std::vector<double> values;
    std::vector<std::uint32_t> named;  // which nodes of the list a cell has; all ones: none
    for (std::uint32_t k = 0; k < grid.cells[2]; ++k)
      for (std::uint32_t j = 0; j < grid.cells[1]; ++j)
        for (std::uint32_t i = 0; i < grid.cells[0]; ++i) {
          const Vec3d center = grid.lower + Vec3d{(i + 0.5) * cell.x, (j + 0.5) * cell.y, (k + 0.5) * cell.z};
          if (grid.isLeftOut && grid.isLeftOut(center)) {
            named.push_back(std::numeric_limits<std::uint32_t>::max());
            continue;
          }
          named.push_back(static_cast<std::uint32_t>(values.size() / kNodes));
          for (const Vec3d& node : nodes())
            values.push_back(
                distance(center + Vec3d{0.5 * cell.x * node.x, 0.5 * cell.y * node.y, 0.5 * cell.z * node.z}));
        }
    putList(values);
    std::vector<std::uint32_t> nodeOf(values.size());
    for (std::uint32_t i = 0; i < nodeOf.size(); ++i) nodeOf[i] = i;
    put(std::uint64_t{1});
    put(std::uint64_t{values.size() / kNodes});
    for (const std::uint32_t i : nodeOf) put(i);
    putList(named);
  }

  std::vector<char>& bytes() { return bytes_; }

 private:
  static constexpr std::size_t kNodes = 32;

  // Of a cell from -1 to 1, in the order in which Bullet's shape functions are numbered.
  static const std::vector<Vec3d>& nodes() {
    static const std::vector<Vec3d> all = [] {
      std::vector<Vec3d> list;
      for (const int z : {-1, 1})
        for (const int y : {-1, 1})
          for (const int x : {-1, 1}) list.emplace_back(x, y, z);
      const auto thirds = {-1.0 / 3, 1.0 / 3};
      for (const int y : {-1, 1})
        for (const int z : {-1, 1})
          for (const double x : thirds) list.emplace_back(x, y, z);
      for (const int z : {-1, 1})
        for (const int x : {-1, 1})
          for (const double y : thirds) list.emplace_back(x, y, z);
      for (const int x : {-1, 1})
        for (const int y : {-1, 1})
          for (const double z : thirds) list.emplace_back(x, y, z);
      return list;
    }();
    return all;
  }

  template <class T>
  void put(const T& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void put(const Vec3d& v) {
    for (const double x : {v.x, v.y, v.z}) put(x);
  }
  template <class T>
  void putList(const std::vector<T>& list) {
    put(std::uint64_t{1});
    put(std::uint64_t{list.size()});
    for (const T& value : list) put(value);
  }

  std::vector<char> bytes_;
};

inline std::shared_ptr<btSdfCollisionShape> fieldShape(const FieldGrid& grid, const Distance& distance) {
  FieldFile file(grid, distance);
  auto shape = std::make_shared<btSdfCollisionShape>();
  if (!shape->initializeSDF(file.bytes().data(), static_cast<int>(file.bytes().size())))
    throw std::runtime_error("Bullet does not take the field");
  return shape;
}

}  // namespace cairn::test

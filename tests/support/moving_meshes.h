// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "test_solids.h"

namespace cairn::test {

/// A solid, and where a point of it is at a phase (radians); at phase 0 it is where it was.
struct MovingMesh {
  std::string name;
  Solid first;
  std::function<Vec3d(const Vec3d& point, double phase)> move;

  std::vector<Vec3d> at(double phase) const {
    std::vector<Vec3d> moved;
    for (const Vec3d& v : first.vertices) moved.push_back(move(v, phase));
    return moved;
  }
  /// In the frame of a tree of it.
  std::vector<Vec3> inTree(const SphereTree& tree, double phase) const {
    std::vector<Vec3> moved;
    for (const Vec3d& v : at(phase)) moved.push_back(Vec3(v - tree.origin()));
    return moved;
  }
};

/// A bar along x that bends up and down: its axis becomes an arc of 1.2 rad at most.
inline MovingMesh bendingBar(int cells) {
  const auto move = [](const Vec3d& p, double phase) {
    const double bend = 0.3 * std::sin(phase);  // rad for each unit of length
    if (std::abs(bend) < 1e-9) return p;
    const double radius = 1 / bend, angle = p.x * bend;
    return Vec3d{(radius - p.z) * std::sin(angle), p.y, radius - (radius - p.z) * std::cos(angle)};
  };
  return {"bending bar", cuboid({4, 0.6, 0.6}, cells), move};
}

/// A ball that swells by a quarter, and more at its top.
inline MovingMesh breathingBall(int subdivisions) {
  const auto move = [](const Vec3d& p, double phase) { return p * (1 + std::sin(phase) * (0.25 + 0.1 * p.z)); };
  return {"breathing ball", ball(1, subdivisions), move};
}

namespace detail {

// Head, trunk, two arms and two legs, in cells of a grid: x to the left, y ahead, z up.
inline bool isFigure(int x, int y, int z) {
  if (y < 0 || y > 1) return false;
  const bool isLeg = z >= 0 && z < 8 && ((x >= 1 && x <= 2) || (x >= 5 && x <= 6));
  const bool isTrunk = z >= 8 && z < 15 && x >= 1 && x <= 6;
  const bool isArm = z >= 13 && z < 15 && x >= -5 && x <= 12;
  const bool isHead = z >= 15 && z < 19 && x >= 2 && x <= 5;
  return isLeg || isTrunk || isArm || isHead;
}

inline Vec3d turnedAboutX(const Vec3d& p, const Vec3d& pivot, double angle) {
  const Vec3d d = p - pivot;
  return pivot +
         Vec3d{d.x, std::cos(angle) * d.y - std::sin(angle) * d.z, std::sin(angle) * d.y + std::cos(angle) * d.z};
}

inline Vec3d turnedAboutZ(const Vec3d& p, const Vec3d& pivot, double angle) {
  const Vec3d d = p - pivot;
  return pivot +
         Vec3d{std::cos(angle) * d.x - std::sin(angle) * d.y, std::sin(angle) * d.x + std::cos(angle) * d.y, d.z};
}

}  // namespace detail

/// A figure 1.9 high whose legs swing from the hips and whose arms swing from the shoulders. Each joint blends two
/// bones linearly, as skinned characters do.
inline MovingMesh walkingFigure(int cellsOfCube) {
  detail::SolidWriter out;
  constexpr double kCell = 0.1;
  const auto axis = [](int k) { return Vec3d{k == 0 ? kCell : 0, k == 1 ? kCell : 0, k == 2 ? kCell : 0}; };
  for (int x = -6; x <= 13; ++x)
    for (int y = 0; y <= 1; ++y)
      for (int z = 0; z < 19; ++z) {
        if (!detail::isFigure(x, y, z)) continue;
        const Vec3d corner = Vec3d{double(x), double(y), double(z)} * kCell;
        for (int k = 0; k < 3; ++k) {
          const Vec3d u = axis((k + 1) % 3), v = axis((k + 2) % 3);
          if (!detail::isFigure(x + (k == 0), y + (k == 1), z + (k == 2)))
            out.patch(corner + axis(k), u, v, cellsOfCube, cellsOfCube);
          if (!detail::isFigure(x - (k == 0), y - (k == 1), z - (k == 2)))
            out.patch(corner, v, u, cellsOfCube, cellsOfCube);
        }
      }
  const auto move = [](const Vec3d& p, double phase) {
    const double side = p.x < 0.4 ? 1 : -1;
    if (p.z < 0.9) {
      const double weight = std::clamp((0.9 - p.z) / 0.2, 0.0, 1.0);
      const Vec3d turned = detail::turnedAboutX(p, {p.x, 0.1, 0.8}, side * 0.6 * std::sin(phase));
      return p + (turned - p) * weight;
    }
    const double beyond = std::max(-p.x, p.x - 0.8), weight = std::clamp(beyond / 0.2, 0.0, 1.0);
    if (p.z < 1.25 || p.z > 1.55 || weight == 0) return p;
    const Vec3d turned = detail::turnedAboutZ(p, {side > 0 ? 0 : 0.8, 0.1, 1.4}, 0.8 * std::sin(phase));
    return p + (turned - p) * weight;
  };
  return {"walking figure", out.solid, move};
}

}  // namespace cairn::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "builder_meshes.h"

namespace cairn::test {

/// A file as CAD programs write it, and what it means: told by formulas, without a mesh.
struct CadCase {
  std::string name;
  builder::TriangleMesh mesh;
  double volume = 0;  ///< of the exact union
  std::size_t shells = 1;
  std::function<bool(const Vec3d&)> isSolid;
  double slack = 0;  ///< how much larger the volume may be: surfaces move by at most twice the weld
  std::string did;   ///< a part of the sentence that says what was done
};

inline constexpr double kWeldOfCad = 2e-5;  ///< the stated default
inline constexpr double kGapOfCad = 1e-5;   ///< of the size, to be joined whichever way it is off

struct Block {
  Vec3d lower, upper;
  builder::TriangleMesh mesh(int cells = 1) const {
    const Vec3d middle = (lower + upper) * 0.5;
    return moved(meshOf(cuboid(upper - lower, cells)), [&](const Vec3d& v) {
      Vec3d p = v + middle;  // exactly on the planes named
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(p[axis] - lower[axis]) < 1e-9) p[axis] = lower[axis];
        if (std::abs(p[axis] - upper[axis]) < 1e-9) p[axis] = upper[axis];
      }
      return p;
    });
  }
  bool has(const Vec3d& p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < lower[axis] || p[axis] > upper[axis]) return false;
    return true;
  }
  double volume() const { return (upper.x - lower.x) * (upper.y - lower.y) * (upper.z - lower.z); }
};

/// An upright prism over a regular polygon, as a cylinder becomes one.
struct Prism {
  Vec3d center;
  double radius = 1, height = 1;
  std::uint32_t sides = 12;

  builder::TriangleMesh mesh() const {
    return moved(cylinder(radius, height, sides), [&](const Vec3d& v) { return v + center; });
  }
  bool has(const Vec3d& p) const {
    if (std::abs(p.z - center.z) > height / 2) return false;
    const double half = std::numbers::pi / sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = (2 * i + 1) * half;
      if ((p.x - center.x) * std::cos(angle) + (p.y - center.y) * std::sin(angle) > radius * std::cos(half))
        return false;
    }
    return true;
  }
  double area() const { return 0.5 * sides * radius * radius * std::sin(2 * std::numbers::pi / sides); }
};

inline builder::TriangleMesh joinedBlocks(const std::vector<Block>& blocks) {
  builder::TriangleMesh mesh = blocks.front().mesh();
  for (std::size_t i = 1; i < blocks.size(); ++i) mesh = joined(mesh, blocks[i].mesh());
  return mesh;
}

/// Blocks, of which only their union's volume is given.
inline CadCase ofBlocks(std::string name, const std::vector<Block>& blocks, double volume, double slack,
                        std::string did) {
  return {std::move(name),
          joinedBlocks(blocks),
          volume,
          1,
          [blocks](const Vec3d& p) {
            return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.has(p); });
          },
          slack,
          std::move(did)};
}

/// The size that the weld and the gap are fractions of.
inline double sizeOf(const builder::TriangleMesh& mesh) {
  return builder::boundsOf(mesh).diagonal();
}

/// Two unit cubes end to end, apart by a fraction of the size; less than zero: they overlap by it.
inline CadCase cubesApart(const std::string& name, double fraction, std::string did) {
  const double size = std::sqrt(6.0), gap = fraction * size;
  return ofBlocks(name, {{{0, 0, 0}, {1, 1, 1}}, {{1 + gap, 0, 0}, {2 + gap, 1, 1}}}, 2 + gap, 2 * kWeldOfCad * size,
                  std::move(did));
}

/// A cube of six separate sheets, each moved outward by the gap, some of them cut finer: open everywhere, and edges
/// have vertices that their neighbours lack.
inline CadCase looseSheets() {
  CadCase result;
  result.name = "looseSheets";
  const double gap = kGapOfCad * std::sqrt(3.0);
  for (int side = 0; side < 6; ++side) {
    const builder::TriangleMesh cube = Block{{0, 0, 0}, {1, 1, 1}}.mesh(side % 3 + 1);
    const std::size_t each = cube.triangles.size() / 6;
    builder::TriangleMesh sheet = cube;
    const auto first = cube.triangles.begin() + static_cast<std::ptrdiff_t>(each * static_cast<std::size_t>(side));
    sheet.triangles.assign(first, first + static_cast<std::ptrdiff_t>(each));
    const auto c = sheet.corners(0);
    const Vec3d out = normalized(cross(c[1] - c[0], c[2] - c[0])) * (gap / 2);
    sheet = moved(sheet, [&](const Vec3d& v) { return v + out; });
    result.mesh = side == 0 ? sheet : joined(result.mesh, sheet);
  }
  result.volume = 1;
  result.slack = 6 * 2 * kWeldOfCad * std::sqrt(3.0);
  result.isSolid = [](const Vec3d& p) { return Block{{0, 0, 0}, {1, 1, 1}}.has(p); };
  result.did = "joined";
  return result;
}

/// Every triangle of an edge's two solids twice, and some a third time, turned.
inline CadCase everythingTwice() {
  CadCase result = ofBlocks("everythingTwice", {{{0, 0, 0}, {2, 1, 1}}}, 2, 0, "duplicate triangles left out");
  builder::TriangleMesh& mesh = result.mesh;
  const std::vector<builder::Triangle> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  for (const std::size_t t : {1, 4, 9}) mesh.triangles.push_back({once[t][1], once[t][0], once[t][2]});
  return result;
}

inline CadCase hollowBlock() {
  const Block outer{{0, 0, 0}, {3, 3, 3}}, inner{{1, 1, 1}, {2, 2, 2}};
  return {"hollowBlock",
          joined(outer.mesh(), flipped(inner.mesh())),
          26,
          2,
          [=](const Vec3d& p) { return outer.has(p) && !inner.has(p); },
          0,
          "nothing"};
}

/// A hollow with a rod through it, out of both ends.
inline CadCase rodThroughAHollow() {
  const Block outer{{0, 0, 0}, {3, 3, 3}}, inner{{1, 1, 1}, {2, 2, 2}}, rod{{1.25, 1.25, -1}, {1.75, 1.75, 4}};
  return {"rodThroughAHollow",
          joined(joined(outer.mesh(), flipped(inner.mesh())), rod.mesh()),
          26 + 0.25 * (1 + 2),
          2,
          [=](const Vec3d& p) { return (outer.has(p) && !inner.has(p)) || rod.has(p); },
          0,
          "2 bodies united"};
}

/// Width of a prism's section at a height above its axis.
inline double widthAt(const Prism& prism, double height) {
  const double half = std::numbers::pi / prism.sides;
  double lower = -prism.radius, upper = prism.radius;
  for (std::uint32_t i = 0; i < prism.sides; ++i) {  // x cos + z sin <= reach
    const double angle = (2 * i + 1) * half, reach = prism.radius * std::cos(half);
    const double rest = reach - height * std::sin(angle), along = std::cos(angle);
    if (along > 1e-12) upper = std::min(upper, rest / along);
    if (along < -1e-12) lower = std::max(lower, rest / along);
  }
  return upper - lower;
}

/// Two equal cylinders that cross at a right angle. Sections of both at a height are rectangles; their widths are
/// linear between corners of the polygon, so Simpson's rule is exact for the product.
inline CadCase crossingCylinders() {
  const Prism upright{{0, 0, 0}, 1, 6, 24};
  const auto alongX = [](const Vec3d& v) { return Vec3d{v.z, v.x, v.y}; };
  const auto alongY = [](const Vec3d& v) { return Vec3d{v.x, -v.z, v.y}; };
  double common = 0;
  std::vector<double> heights;
  for (std::uint32_t i = 0; i <= 12; ++i) heights.push_back(-std::cos(2 * std::numbers::pi * i / 24));
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const double a = heights[i], b = heights[i + 1], m = (a + b) / 2;
    const auto square = [&](double z) { return widthAt(upright, z) * widthAt(upright, z); };
    common += (b - a) / 6 * (square(a) + 4 * square(m) + square(b));
  }
  return {"crossingCylinders",
          joined(moved(upright.mesh(), alongX), moved(upright.mesh(), alongY)),
          2 * 6 * upright.area() - common,
          1,
          [=](const Vec3d& p) {
            return upright.has({p.y, p.z, p.x}) || upright.has({p.x, p.z, -p.y});
          },
          0,
          "2 bodies united"};
}

/// Sixteen bolts through a plate, their heads on it: a face of each head lies in the plate's upper face.
inline CadCase boltsInAPlate() {
  const Block plate{{0, 0, 0}, {8, 8, 0.5}};
  std::vector<Prism> parts;
  builder::TriangleMesh mesh = plate.mesh();
  double volume = plate.volume();
  for (int i = 0; i < 16; ++i) {
    const double x = 1 + 2 * (i % 4), y = 1 + 2 * (i / 4);
    parts.push_back({{x, y, 0.25}, 0.3, 2, 12});
    parts.push_back({{x, y, 0.75}, 0.6, 0.5, 6});
    // Above the head 0.25 of the bolt are free, below the plate 0.75.
    volume += parts[parts.size() - 1].area() * 0.5 + parts[parts.size() - 2].area() * (0.25 + 0.75);
  }
  for (const Prism& p : parts) mesh = joined(mesh, p.mesh());
  return {"boltsInAPlate",
          mesh,
          volume,
          1,
          [=](const Vec3d& p) {
            return plate.has(p) || std::any_of(parts.begin(), parts.end(), [&](const Prism& b) { return b.has(p); });
          },
          0,
          "33 bodies united"};
}

inline std::vector<CadCase> cadCases() {
  std::vector<CadCase> cases;
  cases.push_back(ofBlocks("overlapping", {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}}, 15, 0, "2 bodies united"));
  cases.push_back(cubesApart("touchingFaces", 0, "2 bodies united"));
  cases.push_back(ofBlocks("onAPlate", {{{0, 0, 0}, {4, 4, 1}}, {{1, 1, 1}, {2, 3, 2}}}, 18, 0, "2 bodies united"));
  cases.push_back(cubesApart("gap", kGapOfCad, "1 gap between bodies closed"));
  cases.push_back(cubesApart("overlapOfAGap", -kGapOfCad, "2 bodies united"));
  const double gap = kGapOfCad * std::sqrt(27.0);
  cases.push_back(ofBlocks("crossedBars", {{{0, 1, 0}, {3, 2, 1}}, {{1, 0, 1 + gap}, {2, 3, 2 + gap}}}, 6,
                           9 * 2 * kWeldOfCad * std::sqrt(27.0), "1 gap between bodies closed"));
  cases.push_back(ofBlocks("touchingAlongAnEdge", {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 0}, {2, 2, 1}}}, 2, 1e-8, "edge"));
  cases.push_back(ofBlocks("touchingInAVertex", {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}, 2,
                           6 * 2 * kWeldOfCad * std::sqrt(12.0), "1 gap between bodies closed"));
  cases.push_back(looseSheets());
  cases.push_back(everythingTwice());
  cases.push_back(hollowBlock());
  cases.push_back(rodThroughAHollow());
  cases.push_back(ofBlocks("oneInsideTheOther", {{{0, 0, 0}, {3, 3, 3}}, {{1, 1, 1}, {2, 2, 2}}}, 27, 0,
                           "1 body inside others left out"));
  cases.push_back(crossingCylinders());
  cases.push_back(boltsInAPlate());
  cases.push_back(ofBlocks("coplanarSides", {{{0, 0, 0}, {2, 1, 1}}, {{1, 0, 0}, {3, 1, 1}}}, 3, 0, "2 bodies united"));
  return cases;
}

}  // namespace cairn::test

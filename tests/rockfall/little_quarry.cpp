// SPDX-License-Identifier: GPL-3.0-or-later
#include "little_quarry.h"

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace cairn::test {
namespace {

using Point = std::array<double, 3>;
constexpr double kTop = 100, kTan30 = 0.57735026918962573;

void writeFacet(std::ofstream& out, const Point& a, const Point& b, const Point& c) {
  out << "facet normal 0 0 0\nouter loop\n";
  for (const Point& p : {a, b, c}) out << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
  out << "endloop\nendfacet\n";
}

void writeGround(const std::filesystem::path& file, double fromX, double toX) {
  std::ofstream out(file);
  out.precision(9);
  out << "solid Mesh\n";
  const double y0 = littleHeight(fromX), y1 = littleHeight(toX), z = kLittleHalfWidth;
  writeFacet(out, {fromX, y0, -z}, {fromX, y0, z}, {toX, y1, z});
  writeFacet(out, {fromX, y0, -z}, {toX, y1, z}, {toX, y1, -z});
  out << "endsolid Mesh\n";
}

// A box about the origin, counter-clockwise from outside.
void writeBlock(const std::filesystem::path& file, double a, double b, double c) {
  std::ofstream out(file);
  out << "solid block\n";
  const auto corner = [&](int i) -> Point {
    return {(i & 1 ? a : -a) / 2, (i & 2 ? b : -b) / 2, (i & 4 ? c : -c) / 2};
  };
  for (const auto& f : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    writeFacet(out, corner(f[0]), corner(f[1]), corner(f[2]));
    writeFacet(out, corner(f[0]), corner(f[2]), corner(f[3]));
  }
  out << "endsolid block\n";
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

}  // namespace

double littleHeight(double x) {
  return kTop - kTan30 * std::fmin(x, kLittleSlopeEndsX);
}

void writeLittleQuarry(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  writeGround(folder / "DTM_Blue_zone.stl", -2, kLittleSlopeEndsX);
  writeGround(folder / "DTM_Gray_zone.stl", kLittleSlopeEndsX, kLittleRedFromX);
  writeGround(folder / "DTM_Red_zone.stl", kLittleRedFromX, kLittleGroundEndsX);
  writeBlock(folder / "SP1A.stl", 0.8, 0.6, 0.5);
  writeBlock(folder / "SP2A.stl", 1.2, 0.9, 0.7);
  writeBlock(folder / "SP2B.stl", 1.4, 1.1, 0.8);
  writeBlock(folder / "SP3A.stl", 1.2, 0.6, 0.4);
  const std::string y = std::to_string(littleHeight(kLittleDropX) + kLittleDropHeight);
  write(folder / "positions_P1.xyz", "2 " + y + " -1\n2 " + y + " 1\n");
  write(folder / "positions_P2.xyz", "2 " + y + " 3\n2 " + y + " 5\n\n");
  write(folder / "orientations.txt",
        "q0\tq1\tq2\tq3\n1\t0\t0\t0\n0.9238795325\t0.3826834324\t0\t0\n0.7071067812\t0\t0.7071067812\t0\n0.5\t0.5\t"
        "0.5\t0.5\n");
  write(folder / "Endpoints_P1.txt",
        "20 88.9 0 800 1 0.8 0.6\n22 88.9 1 700 1 0.8 0.5\n23 88.9 -1 650 0.9 0.8 0.5\n25 88.9 0.5 900 1.1 0.8 0.6\n"
        "27 88.9 -2 500 0.8 0.7 0.5\n30 88.9 2 400 0.8 0.6 0.5\n");
  write(folder / "rockable_P1.csv",
        "shape,drop_position,orientation,t_s,x_m,y_m,z_m,max_speed_m_per_s\nSP1A,1,1,19,20,88.9,0,8\n"
        "SP1A,1,2,19,21,88.9,1,8.5\nSP2A,1,1,19,24,88.9,-1,9\nSP3A,2,3,19,18,89.9,0,7\n");
}

}  // namespace cairn::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "medial/voronoi_diagram.h"

// Points of which many lie on one sphere and in one plane: which tetrahedra a Delaunay triangulation has is then free,
// and inexact predicates contradict each other.
//
//     o-----o          o            o--o--o
//    /|    /|         /|\          /  /  /|        o  all integer points
//   o-----o |        o-+-o        o--o--o o      o   o   at one distance
//   | o---|-o         \|/         |  |  |/        o o    from the middle
//   |/    |/           o          o--o--o
//   o-----o
//
// All coordinates are integers, the enclosing sites' too, so the brute-force test is exact: differences are
// below 2200, so that no sum here reaches 2^62.
namespace cairn::hard {
namespace {

using Integer = std::int64_t;
using Site = std::array<std::int64_t, 3>;

/// Its diagonal is 6 * size, a whole number, and so are the coordinates of the eight sites that enclose it.
builder::Bounds roomOf(int size) {
  return {Vec3d(-1, -2, -2) * double(size), Vec3d(1, 2, 2) * double(size)};
}

Site siteOf(const builder::VoronoiDiagram& diagram, std::uint32_t index) {
  const Vec3d& p = diagram.site(index);
  return {static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y), static_cast<std::int64_t>(p.z)};
}

struct Difference {
  Integer x, y, z;
  Difference(const Site& to, const Site& from) : x(to[0] - from[0]), y(to[1] - from[1]), z(to[2] - from[2]) {}
  Integer square() const { return x * x + y * y + z * z; }
};

Integer determinant(const Difference& a, const Difference& b, const Difference& c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

/// Six times the volume, with the sign of the order.
Integer sixVolumes(const std::array<Site, 4>& t) {
  return determinant({t[1], t[0]}, {t[2], t[0]}, {t[3], t[0]});
}

/// Whether the site lies inside, not on, the sphere through the four. Precondition: they are not in one plane.
bool isInside(const std::array<Site, 4>& t, Integer orientation, const Site& site) {
  const Difference a(t[0], site), b(t[1], site), c(t[2], site), d(t[3], site);
  const Integer lifted = a.square() * determinant(b, c, d) - b.square() * determinant(a, c, d) +
                         c.square() * determinant(a, b, d) - d.square() * determinant(a, b, c);
  return orientation > 0 ? lifted > 0 : lifted < 0;
}

struct Violations {
  std::uint64_t tetrahedra = 0, notEmpty = 0, flat = 0, volumes = 0;
};

void examine(const std::vector<Vec3d>& points, int size, Violations& violations) {
  builder::VoronoiDiagram diagram(roomOf(size));
  for (const Vec3d& p : points) diagram.insert(p);
  std::vector<Site> sites;
  for (std::uint32_t i = 0; i < diagram.siteCount(); ++i) sites.push_back(siteOf(diagram, i));
  Integer filled = 0;
  for (const builder::VoronoiVertex& vertex : diagram.vertices()) {
    if (!vertex.alive) continue;
    std::array<Site, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = sites[vertex.sites[i]];
    const Integer volume = sixVolumes(corners);
    ++violations.tetrahedra;
    violations.flat += volume == 0 ? 1 : 0;
    filled += volume < 0 ? -volume : volume;
    if (volume == 0) continue;
    for (const Site& site : sites) violations.notEmpty += isInside(corners, volume, site) ? 1 : 0;
  }
  const Integer side = 2 * 4 * 6 * Integer(size);  // of the cube the enclosing sites are the corners of
  violations.volumes += filled == 6 * side * side * side ? 0 : 1;
}

/// The integer points of the room, by `step`; turned, by a rotation whose entries are thirds, three times as far apart.
std::vector<Vec3d> grid(int size, int step, bool turned) {
  std::vector<Vec3d> points;
  for (int x = -size; x <= size; x += step)
    for (int y = -size; y <= size; y += step)
      for (int z = -size; z <= size; z += step)
        points.push_back(turned ? Vec3d(2 * x - y + 2 * z, 2 * x + 2 * y - z, -x + 2 * y + 2 * z) : Vec3d(x, y, z));
  return points;
}

/// All integer points on the sphere around the origin whose radius squared is this.
std::vector<Vec3d> onSphere(int radiusSquared, int most) {
  std::vector<Vec3d> points;
  for (int x = -most; x <= most; ++x)
    for (int y = -most; y <= most; ++y)
      for (int z = -most; z <= most; ++z)
        if (x * x + y * y + z * z == radiusSquared) points.push_back(Vec3d(x, y, z));
  return points;
}

const std::vector<Vec3d> kCube{{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                               {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
const std::vector<Vec3d> kOctahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

Outcome runCosphericalPoints(Effort effort) {
  const bool quick = effort == Effort::quick;
  Violations violations;
  examine(kCube, 2, violations);
  examine(kOctahedron, 2, violations);
  const int half = quick ? 3 : 6;
  examine(grid(half, 1, false), half, violations);
  examine(grid(half, 1, true), 5 * half, violations);
  examine(onSphere(quick ? 101 : 2021, quick ? 11 : 45), quick ? 11 : 45, violations);

  FamilyDemands demands(effort, 20);
  demands.build(test::meshOf(test::cuboid({2, 2, 2}, 1)));
  demands.build(test::meshOf(test::ball(1, 1)));
  demands.build(test::meshOf(test::cuboid({2, 2, 2}, 6)));
  const std::string many = "of " + std::to_string(violations.tetrahedra);
  const auto none = [](const char* name, std::uint64_t count, const std::string& unit) {
    return Measure{name, double(count), 0, Bound::atMost, unit, "", 0};
  };
  Outcome outcome{{none("sites inside a tetrahedron's sphere", violations.notEmpty, many),
                   none("flat tetrahedra", violations.flat, many),
                   none("diagrams that do not fill their hull", violations.volumes, "of 5")},
                  ""};
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase cosphericalPoints() {
  return {"G1", "cube, octahedron, grid, integer points of a sphere",
          "no site inside the sphere of a tetrahedron, tetrahedra fill the hull: both exactly, in integers, where the "
          "proposed list allows 1e-9 of the size; trees of cube, octahedron and gridded cube",
          runCosphericalPoints};
}

}  // namespace cairn::hard

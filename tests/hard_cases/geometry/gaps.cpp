// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "builder_meshes.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "scenes/truth/exact_check.h"
#include "surface/mass_properties.h"

// Solids with gaps a ball may close over: what passes through them in the world must not be told to be in contact by
// more than the tree states.
//
//       .--""--.            _  _  _  _
//     .'  .--.  '.         | || || || |        ((( a wire wound three times, the
//    (   (    )   )        | || || || |        ))) turns a fifth of their width apart
//     '.  '--'  .'         | \/ \/ \/ |        (((
//       '--..--'           |__________|
namespace cairn::hard {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A round wire along a helix about z, closed at both ends by fans.
builder::TriangleMesh spiral(double radius, double wire, double rise, int turns, int around) {
  builder::TriangleMesh mesh;
  const auto sides = static_cast<std::uint32_t>(around / 2), rings = static_cast<std::uint32_t>(turns * around);
  const auto middle = [&](std::uint32_t ring) {
    const double u = 2 * kPi * ring / around;
    return Vec3d{radius * std::cos(u), radius * std::sin(u), rise * u / (2 * kPi)};
  };
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / sides;
      const Vec3d out{std::cos(u), std::sin(u), 0};
      mesh.vertices.push_back(middle(i) + out * (wire * std::cos(v)) + Vec3d{0, 0, wire * std::sin(v)});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t a = i * sides + j, b = i * sides + (j + 1) % sides, c = a + sides, d = b + sides;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
  for (const std::uint32_t end : {0U, rings}) {
    const auto hub = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middle(end));
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t a = end * sides + j, b = end * sides + (j + 1) % sides;
      mesh.triangles.push_back(end == 0 ? builder::Triangle{hub, a, b} : builder::Triangle{hub, b, a});
    }
  }
  return builder::signedVolume(mesh) > 0 ? mesh : test::flipped(mesh);
}

/// Teeth on a back, the gaps as wide as the teeth: the outer faces of cubes of side 1.
builder::TriangleMesh comb(int teeth, int height) {
  const auto isSolid = [&](int x, int y, int z) {
    const bool inside = x >= 0 && x < 2 * teeth - 1 && y >= 0 && y < 2 && z >= 0 && z <= height;
    return inside && (z == 0 || x % 2 == 0);
  };
  test::detail::SolidWriter out;
  for (int x = 0; x < 2 * teeth - 1; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z <= height; ++z) {
        if (!isSolid(x, y, z)) continue;
        const Vec3d p(x, y, z), u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
        if (!isSolid(x, y, z - 1)) out.patch(p, v, u, 1, 1);
        if (!isSolid(x, y - 1, z)) out.patch(p, u, w, 1, 1);
        if (!isSolid(x - 1, y, z)) out.patch(p, w, v, 1, 1);
        if (!isSolid(x, y, z + 1)) out.patch(p + w, u, v, 1, 1);
        if (!isSolid(x, y + 1, z)) out.patch(p + v, w, u, 1, 1);
        if (!isSolid(x + 1, y, z)) out.patch(p + u, v, w, 1, 1);
      }
  return test::meshOf(out.solid);
}

/// How much farther from the solid than its stated error points of a ball are, over all nodes, as part of the size;
/// below 0 where there is room. By CGAL's distances.
double beyondStated(const SphereTree& tree, const builder::TriangleMesh& mesh, int directions) {
  std::vector<std::array<std::uint32_t, 3>> triangles(mesh.triangles.begin(), mesh.triangles.end());
  const auto surface = scenes::ExactSurface::create(mesh.vertices, triangles);
  if (!surface) throw std::runtime_error(surface.error().message);
  std::mt19937_64 engine(14);
  double most = -HUGE_VAL;
  for (const NodeData& node : tree.data().nodes) {
    const Vec3d center = tree.origin() + Vec3d(node.center);
    for (int i = 0; i < directions; ++i) {
      const Vec3d p = center + normalized(test::randomPoint(engine)) * double(node.radius);
      most = std::max(most, -surface.value().depth(p) - double(node.error));
    }
  }
  return most / builder::boundsOf(mesh).diagonal();
}

Outcome runGaps(Effort effort) {
  const bool quick = effort == Effort::quick;
  FamilyDemands demands(effort, 120);
  Outcome outcome;
  struct Solid {
    const char* name;
    builder::TriangleMesh mesh;
    double gap;
  };
  const int fine = quick ? 8 : 32;
  const std::uint32_t depth = demands.options().depth;
  for (const Solid& solid : {Solid{"torus", test::torus(1, 0.3, 2 * fine, fine), 1.4},
                             {"spiral", spiral(1, 0.2, 0.48, 3, 2 * fine), 0.08},
                             {"comb", comb(5, 4), 1}}) {
    const auto tree = demands.build(solid.mesh);
    if (!tree) continue;
    const std::string name = solid.name;
    outcome.measures.push_back({name + ": ball's points beyond the stated error",
                                beyondStated(*tree, solid.mesh, quick ? 20 : 500), 0, Bound::atMost, "of size", "", 0});
    outcome.measures.push_back({name + ": stated error of the leaves over the gap's width",
                                double(tree->levelError(depth)) / solid.gap, quick ? 4 : 0.6, Bound::atMost, "", "",
                                0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase gaps() {
  return {
      "G14", "torus, spiral, comb",
      "no point of any ball, of any level, is farther from the solid than the ball states (proposed list), by CGAL's "
      "distances over points of its sphere; leaves err by less than the width of the gaps",
      runGaps};
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_from_bytes.h"

#include <cmath>
#include <limits>

#include "builder_meshes.h"

namespace cairn::fuzz {
namespace {

using builder::TriangleMesh;

TriangleMesh solidFrom(Bytes& bytes) {
  const int fine = 1 + int(bytes.below(3));
  switch (bytes.below(6)) {
    case 0:
      return test::meshOf(test::cuboid({2, 1.5, 1}, fine));
    case 1:
      return test::meshOf(test::ball(1, fine + 1));
    case 2:
      return test::torus(1, 0.3, 6 + 3 * std::uint32_t(fine), 3 + std::uint32_t(fine));
    case 3:
      return test::lumpyBall(fine, bytes.next());
    case 4:
      return test::cylinder(1, 0.5 * fine, 3 + bytes.below(12));
    default:
      return test::meshOf(test::twoCuboids({1, 1, 1}, {1.5, 0.2, 0.1}, fine));
  }
}

/// -1 to 1, or a power of ten of it.
double lengthFrom(Bytes& bytes) {
  const double part = (double(bytes.next()) - 127.5) / 127.5;
  return part * std::pow(10.0, -double(bytes.below(14)));
}

void damageTriangle(TriangleMesh& mesh, Bytes& bytes) {
  const std::uint32_t t = bytes.below(std::uint32_t(mesh.triangles.size()));
  builder::Triangle& triangle = mesh.triangles[t];
  switch (bytes.below(4)) {
    case 0:
      return mesh.triangles.push_back(builder::Triangle(triangle));
    case 1:
      return std::swap(triangle[0], triangle[1]);
    case 2:
      mesh.triangles.erase(mesh.triangles.begin() + t);
      return;
    default:
      triangle[bytes.below(3)] = bytes.below(std::uint32_t(mesh.vertices.size()) + 1);  // one beyond the last at most
  }
}

void damageVertex(TriangleMesh& mesh, Bytes& bytes) {
  const std::uint32_t v = bytes.below(std::uint32_t(mesh.vertices.size()));
  Vec3d& vertex = mesh.vertices[v];
  switch (bytes.below(5)) {
    case 0:  // welded
      vertex = mesh.vertices[bytes.below(std::uint32_t(mesh.vertices.size()))];
      return;
    case 1:  // split: the first triangle that uses it gets its own
      for (builder::Triangle& t : mesh.triangles)
        for (std::uint32_t& corner : t)
          if (corner == v) {
            corner = std::uint32_t(mesh.vertices.size());
            return mesh.vertices.push_back(Vec3d(vertex));
          }
      return;
    case 2: {
      const double poison[] = {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL, 1e300, 1e-310};
      vertex[int(bytes.below(3))] = poison[bytes.below(5)];
      return;
    }
    default:
      vertex += {lengthFrom(bytes), lengthFrom(bytes), lengthFrom(bytes)};
  }
}

void damageWhole(TriangleMesh& mesh, Bytes& bytes) {
  const double factor = std::pow(10.0, double(bytes.below(25)) - 12);
  const int axis = int(bytes.below(3));
  switch (bytes.below(6)) {
    case 0:
      for (Vec3d& v : mesh.vertices) v[axis] *= factor;  // a plate or a rod
      return;
    case 1:
      for (Vec3d& v : mesh.vertices) v *= factor;
      return;
    case 2:
      for (Vec3d& v : mesh.vertices) v[axis] += factor;
      return;
    case 3:
      mesh = test::flipped(mesh);
      return;
    case 4:
      for (Vec3d& v : mesh.vertices) v[axis] = -v[axis];
      return;
    default: {
      const Vec3d shift{3 * lengthFrom(bytes), 3 * lengthFrom(bytes), 3 * lengthFrom(bytes)};
      mesh = test::joined(mesh, test::moved(mesh, [&](const Vec3d& v) { return v + shift; }));
    }
  }
}

}  // namespace

TriangleMesh meshFrom(Bytes& bytes) {
  TriangleMesh mesh = solidFrom(bytes);
  const std::uint32_t damages = bytes.below(5);
  for (std::uint32_t i = 0; i < damages && !mesh.triangles.empty() && mesh.triangles.size() < 1000; ++i)
    switch (bytes.below(3)) {
      case 0:
        damageTriangle(mesh, bytes);
        break;
      case 1:
        damageVertex(mesh, bytes);
        break;
      default:
        damageWhole(mesh, bytes);
    }
  return mesh;
}

builder::BuildOptions optionsFrom(Bytes& bytes) {
  builder::BuildOptions options;
  options.method = builder::Method(bytes.below(std::uint32_t(builder::methodNames().size())));
  options.branching = builder::dividesByEight(options.method) ? 8 : 2 + bytes.below(7);
  options.depth = 1 + bytes.below(2);
  options.samples = 100 + bytes.below(200);
  if (bytes.next() == 255) options.branching = options.depth = bytes.below(12);
  if (options.depth > 4) options.depth = 2;  // seven levels of seven children are allowed, and take minutes
  options.seed = bytes.next();
  options.threads = 1;
  const std::uint32_t treatment = builder::fitsRegions(options.method) ? bytes.below(6) : 4;
  if (treatment < 3) options.optimiser = builder::Optimiser(treatment);
  if (treatment == 3) options.balance = builder::constantExcess(0.05);
  return options;
}

}  // namespace cairn::fuzz

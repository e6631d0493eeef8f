// SPDX-License-Identifier: GPL-3.0-or-later
#include "certify/record_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

constexpr double kMassTolerance = 1e-9;
/// Tolerance for a cosine or a squared length in double, with a margin.
constexpr double kRounding = 0x1p-46;

/// Describes the first difference of the stored mesh, if any.
std::optional<std::string> meshFailure(const SphereTree& tree, const TriangleMesh& mesh) {
  if (tree.vertices().size() != mesh.vertices.size() || tree.triangles().size() != mesh.triangles.size())
    return fmt::format("the tree stores a mesh of {} vertices and {} triangles, the mesh has {} and {}",
                       tree.vertices().size(), tree.triangles().size(), mesh.vertices.size(), mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3d expected = mesh.vertices[v] - tree.origin(), stored(tree.vertices()[v]);
    for (int axis = 0; axis < 3; ++axis) {
      const double rounding = 0x1p-23 * std::abs(expected[axis]) + std::numeric_limits<float>::min();
      if (!(std::abs(stored[axis] - expected[axis]) <= rounding))
        return fmt::format("vertex {} of the tree's mesh is {:.3g} from the mesh's", v, distance(stored, expected));
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (tree.triangles()[t] != mesh.triangles[t])
      return fmt::format("triangle {} of the tree's mesh has other vertices than the mesh's", t);
  return std::nullopt;
}

double largestDifference(const Mat3d& a, const Mat3d& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
  return largest;
}

/// The inertia tensor of the principal axes and moments.
Mat3d inertiaFrom(const MassProperties& mass) {
  Mat3d scaled = mass.principalAxes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) scaled(i, j) *= mass.principalMoments[j];
  return scaled * transpose(mass.principalAxes);
}

void compareMass(const MassProperties& stored, const TriangleMesh& mesh, std::vector<std::string>& failures) {
  const MassProperties mass = massPropertiesOf(mesh);
  const double length = boundsOf(mesh).diagonal();
  const double moment = kMassTolerance * (mass.inertia(0, 0) + mass.inertia(1, 1) + mass.inertia(2, 2));
  if (!(std::abs(stored.volume - mass.volume) <= kMassTolerance * mass.volume))
    failures.push_back(fmt::format("the volume is {:.12g}, the mesh's is {:.12g}", stored.volume, mass.volume));
  if (const double d = distance(stored.centerOfMass, mass.centerOfMass); !(d <= kMassTolerance * length))
    failures.push_back(fmt::format("the centre of mass is {:.3g} from the mesh's", d));
  if (const double d = largestDifference(stored.inertia, mass.inertia); !(d <= moment))
    failures.push_back(fmt::format("the inertia differs from the mesh's by {:.3g}", d));
  if (const double d = largestDifference(inertiaFrom(stored), mass.inertia); !(d <= moment))
    failures.push_back(fmt::format("the principal moments and axes give an inertia that differs by {:.3g}", d));
}

class NodeCheck {
 public:
  NodeCheck(const SphereTree& tree, const TriangleMesh& mesh) : tree_(tree) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      normals_.push_back(normalized(cross(b - a, c - a)));
    }
  }

  /// Triangle numbers refer to the stored mesh, which must have been compared.
  std::optional<std::string> coneFailure(std::uint32_t record) const {
    const NormalCone& cone = tree_.data().nodes[record].normalCone;
    if (cone.cosine <= -1) return std::nullopt;
    const Vec3d axis = normalized(Vec3d(cone.axis));
    for (const std::uint32_t t : tree_.regionTriangles(tree_.nodeAt(record))) {
      const double cosine = dot(normals_[t], axis);
      if (!(cosine >= static_cast<double>(cone.cosine) - kRounding))
        return fmt::format("node {}: its normal cone has the cosine {:.9g}, but the normal of triangle {} has {:.9g}",
                           record, cone.cosine, t, cosine);
    }
    return std::nullopt;
  }

  std::optional<std::string> supportFailure(std::uint32_t record) const {
    const NodeData& node = tree_.data().nodes[record];
    const auto points = tree_.supportPoints(tree_.nodeAt(record));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double outside = distance(Vec3d(points[i]), Vec3d(node.center)) - static_cast<double>(node.radius);
      if (!(outside <= kRounding * static_cast<double>(node.radius)))
        return fmt::format("node {}: its support point {} lies {:.3g} outside its ball", record, i, outside);
    }
    return std::nullopt;
  }

 private:
  const SphereTree& tree_;
  std::vector<Vec3d> normals_;  // unit, by triangle
};

}  // namespace

std::vector<std::string> recordFailures(const SphereTree& tree, const TriangleMesh& mesh) {
  std::vector<std::string> failures;
  const auto note = [&](std::optional<std::string> failure) {
    if (failure) failures.push_back(std::move(*failure));
  };
  const std::optional<std::string> otherMesh = meshFailure(tree, mesh);
  note(otherMesh);
  compareMass(tree.mass(), mesh, failures);
  const NodeCheck check(tree, mesh);
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    if (!otherMesh) note(check.coneFailure(record));
    note(check.supportFailure(record));
  }
  return failures;
}

}  // namespace cairn::builder

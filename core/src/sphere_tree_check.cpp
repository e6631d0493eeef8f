// SPDX-License-Identifier: Zlib
#include "sphere_tree_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace cairn {

namespace {

// Unit vectors are rounded to float and matrices computed in double: both pass with room, damage does not.
constexpr float kUnitTolerance = 1e-4F;
constexpr double kOrthonormalTolerance = 1e-9;
// Coordinates beyond this many radii from the centre of the root's ball cannot come from a mesh in that ball. `certify`
// proves a tree against its mesh; this check only excludes overflow.
constexpr double kProportion = 16;
constexpr std::size_t kMaxNodes = std::size_t{1} << 26;

Error bad(const std::string& what) {
  return Error{"the tree is damaged: " + what + "; build it again with `cairn build`"};
}

std::string nth(const char* what, std::size_t index) {
  return std::string(what) + " " + std::to_string(index);
}

bool isUnit(const Vec3& v) {
  return isFinite(v) && std::abs(lengthSq(v) - 1) < kUnitTolerance;
}

bool rangeFits(std::uint64_t first, std::uint64_t count, std::size_t size) {
  return first + count <= size;
}

Status checkBall(const Sphere& ball, const std::string& name) {
  const Vec3& c = ball.center;
  if (!isFinite(c) || !std::isfinite(ball.radius)) return bad(name + " has a number that is not finite");
  if (!(ball.radius > 0)) return bad(name + " has no positive radius");
  if (std::max({ball.radius, std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > kMaxLength)
    return bad(name + " lies outside the range of lengths that can be tested");
  return {};
}

Status checkNumbers(const NodeData& n, const std::string& name) {
  if (Status s = checkBall({n.center, n.radius}, name); !s) return s;
  if (!std::isfinite(n.error) || !std::isfinite(n.innerRadius)) return bad(name + " has a number that is not finite");
  if (n.error < 0) return bad(name + " has a negative error");
  if (n.innerRadius < 0 || n.innerRadius > n.radius) return bad(name + " has an inner radius outside 0 to its radius");
  if (!isUnit(n.normalCone.axis) || !(std::abs(n.normalCone.cosine) <= 1))
    return bad(name + " has a normal cone that is not one");
  return {};
}

Status checkRanges(const SphereTreeData& d, const NodeData& n, const std::string& name) {
  if (n.supportCount == 0 || n.supportCount > kMaxSupportPoints ||
      !rangeFits(n.firstSupport, n.supportCount, d.supportPoints.size()))
    return bad(name + " has a wrong range of support points");
  if (n.normalCount > kMaxFaceNormals || !rangeFits(n.firstNormal, n.normalCount, d.faceNormals.size()))
    return bad(name + " has a wrong range of face normals");
  if (n.triangleCount == 0 || !rangeFits(n.firstTriangle, n.triangleCount, d.regionTriangles.size()))
    return bad(name + " has a wrong range of triangles");
  return {};
}

Status checkLink(const SphereTreeData& d, std::size_t i, const std::string& name) {
  const NodeData& n = d.nodes[i];
  if (i == 0) return n.parent == 0 ? Status() : bad("the root has a parent");
  if (n.parent >= i || n.parent < d.nodes[i - 1].parent) return bad(name + " is not in breadth-first order");
  const NodeData& parent = d.nodes[n.parent];
  const std::uint64_t end = std::uint64_t{n.firstTriangle} + n.triangleCount;
  if (n.firstTriangle < parent.firstTriangle || end > std::uint64_t{parent.firstTriangle} + parent.triangleCount)
    return bad(name + " has triangles outside its parent's");
  return {};
}

Status checkNodes(const SphereTreeData& d) {
  if (d.nodes.empty()) return bad("it has no nodes");
  if (d.nodes.size() > kMaxNodes) return bad("it has more than " + std::to_string(kMaxNodes) + " nodes");
  std::vector<std::uint8_t> level(d.nodes.size(), 0);
  std::vector<std::uint8_t> children(d.nodes.size(), 0);
  for (std::size_t i = 0; i < d.nodes.size(); ++i) {
    const NodeData& n = d.nodes[i];
    const std::string name = nth("node", i);
    if (Status s = checkNumbers(n, name); !s) return s;
    if (Status s = checkRanges(d, n, name); !s) return s;
    if (Status s = checkLink(d, i, name); !s) return s;
    if (i == 0) continue;
    level[i] = static_cast<std::uint8_t>(level[n.parent] + 1);
    if (level[i] > kMaxDepth) return bad(name + " lies deeper than " + std::to_string(kMaxDepth) + " levels");
    if (++children[n.parent] > kFamilyWidth) return bad(nth("node", n.parent) + " has more than eight children");
  }
  return {};
}

Status checkBounds(const SphereTreeData& d) {
  if (!d.bounds.empty() && d.bounds.size() != d.nodes.size())
    return bad("it has " + std::to_string(d.bounds.size()) + " bounds for " + std::to_string(d.nodes.size()) +
               " nodes");
  for (std::size_t i = 0; i < d.bounds.size(); ++i)
    if (Status s = checkBall(d.bounds[i], "the bound of " + nth("node", i)); !s) return s;
  return {};
}

Status checkIndices(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                    const std::string& of) {
  if (vertices.empty() || triangles.empty()) return bad(of + "it has no mesh");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!isFinite(vertices[i])) return bad(of + nth("vertex", i) + " is not finite");
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t v : triangles[i])
      if (v >= vertices.size()) return bad(of + nth("triangle", i) + " names a vertex that does not exist");
  return {};
}

Status checkLevelMeshes(const SphereTreeData& d) {
  if (d.levelMeshes.size() > kMaxDepth) return bad("it has more level meshes than a tree may have levels");
  for (std::size_t i = 0; i < d.levelMeshes.size(); ++i) {
    const LevelMesh& mesh = d.levelMeshes[i];
    const std::string of = "of " + nth("level mesh", i + 1) + ": ";
    if (Status s = checkIndices(mesh.vertices, mesh.triangles, of); !s) return s;
    if (!(mesh.distance >= 0) || !std::isfinite(mesh.distance)) return bad(of + "its distance is not a length");
  }
  return {};
}

Status checkMeshPart(const SphereTreeData& d) {
  if (Status s = checkIndices(d.vertices, d.triangles, ""); !s) return s;
  if (Status s = checkLevelMeshes(d); !s) return s;
  for (std::size_t i = 0; i < d.regionTriangles.size(); ++i)
    if (d.regionTriangles[i] >= d.triangles.size()) return bad(nth("region triangle", i) + " does not exist");
  for (std::size_t i = 0; i < d.supportPoints.size(); ++i)
    if (!isFinite(d.supportPoints[i])) return bad(nth("support point", i) + " is not finite");
  for (std::size_t i = 0; i < d.faceNormals.size(); ++i)
    if (!isUnit(d.faceNormals[i])) return bad(nth("face normal", i) + " is not a unit vector");
  return {};
}

bool isFinite(const Mat3d& m) {
  return cairn::isFinite(m.rows[0]) && cairn::isFinite(m.rows[1]) && cairn::isFinite(m.rows[2]);
}

bool isRotation(const Mat3d& m) {
  if (!isFinite(m)) return false;
  const Mat3d product = transpose(m) * m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(product(i, j) - (i == j ? 1 : 0)) > kOrthonormalTolerance) return false;
  return dot(cross(m.rows[0], m.rows[1]), m.rows[2]) > 0;
}

Status checkMass(const SphereTreeData& d) {
  const MassProperties& m = d.mass;
  if (!cairn::isFinite(d.origin)) return bad("its origin is not finite");
  if (!std::isfinite(m.volume) || !(m.volume > 0)) return bad("its volume is not positive");
  if (!cairn::isFinite(m.centerOfMass) || !isFinite(m.inertia)) return bad("its mass properties are not finite");
  if (!cairn::isFinite(m.principalMoments)) return bad("its moments of inertia are not finite");
  for (int axis = 0; axis < 3; ++axis)
    if (!(m.principalMoments[axis] > 0)) return bad("its moments of inertia are not positive");
  if (!isRotation(m.principalAxes)) return bad("its principal axes are not a rotation");
  return {};
}

// A solid of volume V in a ball of radius R has for each unit of mass moments up to (2R)^2, and no less than what lies
// around the axis as a rod 2R long: V / (4 pi R).
Status checkProportions(const SphereTreeData& d) {
  const Vec3d center(d.nodes[0].center);
  const double reach = kProportion * double(d.nodes[0].radius);
  const auto isNear = [&](const Vec3d& p) { return distance(p, center) <= reach; };
  for (std::size_t i = 0; i < d.vertices.size(); ++i)
    if (!isNear(Vec3d(d.vertices[i]))) return bad(nth("vertex", i) + " lies far outside the root's ball");
  for (std::size_t i = 0; i < d.levelMeshes.size(); ++i)
    for (const Vec3& vertex : d.levelMeshes[i].vertices)
      if (!isNear(Vec3d(vertex))) return bad(nth("level mesh", i + 1) + " reaches far outside the root's ball");
  for (std::size_t i = 0; i < d.supportPoints.size(); ++i)
    if (!isNear(Vec3d(d.supportPoints[i]))) return bad(nth("support point", i) + " lies far outside the root's ball");
  const MassProperties& m = d.mass;
  if (!isNear(m.centerOfMass - d.origin)) return bad("its centre of mass lies far outside the root's ball");
  if (!(m.volume <= 8 * reach * reach * reach)) return bad("its volume is far more than the root's ball holds");
  const double most = 4 * reach * reach, least = m.volume / (4 * std::numbers::pi * reach);
  const auto isMoment = [&](double moment) { return moment <= most && moment >= least; };
  for (int axis = 0; axis < 3; ++axis)
    if (!isMoment(m.principalMoments[axis]) || !isMoment(m.inertia(axis, axis)) ||
        length(m.inertia.rows[axis]) > 2 * most)
      return bad("no solid of its size and volume has its moments of inertia");
  return {};
}

}  // namespace

Status checkTree(const SphereTreeData& data) {
  if (Status s = checkMeshPart(data); !s) return s;
  if (Status s = checkMass(data); !s) return s;
  if (Status s = checkNodes(data); !s) return s;
  if (Status s = checkBounds(data); !s) return s;
  return checkProportions(data);
}

}  // namespace cairn

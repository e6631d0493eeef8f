// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "balls/enclosing_ball.h"
#include "cairn/core/outward_rounding.h"
#include "certify/protrusion.h"
#include "regions/region_normals.h"
#include "regions/support_points.h"
#include "surface/mass_properties.h"

namespace cairn::builder {

namespace {

/// The records of one node, before all records are joined.
struct NodeParts {
  NodeData record;
  Sphere bound;  // of trees with two spheres a node
  std::vector<Vec3> supportPoints, faceNormals;
  std::vector<std::uint32_t> triangles;  // of a leaf
};

class Writer {
 public:
  Writer(const RegionTree& regions, const SignedDistance& solid, bool twoSpheres)
      : regions_(regions), solid_(solid), twoSpheres_(twoSpheres) {
    data_.mass = massPropertiesOf(solid.mesh());
    data_.origin = Vec3d(Vec3(data_.mass.centerOfMass));
    double reach = 0;
    for (const Vec3d& v : solid.mesh().vertices) {
      const Vec3d local = v - data_.origin;
      data_.vertices.emplace_back(local);
      reach = std::max({reach, std::abs(local.x), std::abs(local.y), std::abs(local.z)});
    }
    for (const Triangle& t : solid.mesh().triangles) data_.triangles.push_back(t);
    // A vertex rounded to float moves by at most sqrt(3) 2^-25 of the largest coordinate. The corners of pieces (forty
    // midpoints in double) and the distances measured here differ by less than 2^-46 of it. 2^-23 covers both. So the
    // balls hold the given mesh and the stored mesh.
    guard_ = 0x1p-23 * reach;
  }

  SphereTreeData write() {
    std::vector<NodeParts> parts(regions_.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) { parts[i] = partsOf(i); });
    for (NodeParts& p : parts) append(p);
    layOutTriangles(0, parts);
    return std::move(data_);
  }

 private:
  Vec3d toTree(const Vec3d& p) const { return p - data_.origin; }

  NodeParts partsOf(std::size_t index) const {
    const RegionNode& node = regions_[index];
    NodeParts parts;
    parts.record.parent = node.parent;
    if (node.region.pieces.empty()) return insideParts(node);
    const std::vector<Vec3d> corners = cornersOf(node.region.pieces);
    std::vector<Vec3d> held = corners;
    if (node.region.filled) {
      const std::vector<Vec3d> cube = cubeCorners(node.region.cube);
      held.insert(held.end(), cube.begin(), cube.end());
    }
    writeBalls(node.region.ball, held, parts);
    const std::vector<FacingArea> areas = facingAreas(node.region.pieces, solid_.mesh());
    parts.faceNormals = dominantNormals(areas);
    parts.record.normalCone = normalConeOf(areas);
    for (const Vec3d& p : chooseSupportPoints(corners, areas, kMaxSupportPoints, guard_))
      parts.supportPoints.emplace_back(toTree(p));
    if (node.childCount == 0) parts.triangles = sourcesOf(node.region.pieces);
    return parts;
  }

  std::uint32_t nearestOf(const Pieces& pieces, const Vec3d& point) const {
    std::uint32_t nearest = 0;
    double least = INFINITY;
    for (const std::uint32_t source : sourcesOf(pieces)) {
      const double d = solid_.distanceToTriangle(source, point);
      if (d >= least) continue;
      least = d;
      nearest = source;
    }
    return nearest;
  }

  static std::vector<Vec3d> cubeCorners(const Cube& cube) {
    std::vector<Vec3d> corners;
    for (unsigned i = 0; i < 8; ++i) corners.push_back(cornerOf(cube, i));
    return corners;
  }

  /// A leaf inside the solid holds no surface. Its cube's corners represent it in contacts. It names the triangle of
  /// its parent that is nearest to its centre, as the first exit surface; its normal cone is the whole sphere.
  NodeParts insideParts(const RegionNode& node) const {
    NodeParts parts;
    parts.record.parent = node.parent;
    const std::vector<Vec3d> corners = cubeCorners(node.region.cube);
    writeBalls(node.region.ball, corners, parts);
    for (const Vec3d& p : corners) parts.supportPoints.emplace_back(toTree(p));
    parts.triangles = {nearestOf(regions_[node.parent].region.pieces, node.region.ball.center)};
    return parts;
  }

  Vec3d centerOf(const Sphere& sphere) const { return data_.origin + Vec3d(sphere.center); }

  /// The sphere around about this centre that holds the corners.
  Sphere sphereAround(const Vec3d& center, const std::vector<Vec3d>& corners) const {
    Sphere sphere{Vec3(toTree(center)), 0};
    double farthestSq = 0;
    for (const Vec3d& p : corners) farthestSq = std::max(farthestSq, lengthSq(p - centerOf(sphere)));
    sphere.radius = roundUp(std::sqrt(farthestSq) + guard_);
    return sphere;
  }

  void writeBalls(const Ball& ball, const std::vector<Vec3d>& corners, NodeParts& parts) const {
    NodeData& record = parts.record;
    const Sphere sphere = sphereAround(ball.center, corners);
    record.center = sphere.center;
    record.radius = sphere.radius;
    if (twoSpheres_) parts.bound = sphereAround(smallestEnclosingBall(corners).center, corners);
    const CertifiedProtrusion protrusion =
        certifiedProtrusion(solid_, centerOf(sphere), record.radius, defaultProtrusionTolerance(solid_));
    record.error = roundUp(protrusion.upper);
    record.innerRadius = std::clamp(roundDown(protrusion.depth - guard_), 0.0F, record.radius);
  }

  static std::vector<std::uint32_t> sourcesOf(const Pieces& pieces) {
    std::vector<std::uint32_t> sources;
    for (const Piece& piece : pieces) sources.push_back(piece.source);
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    return sources;
  }

  void append(NodeParts& parts) {
    NodeData& record = parts.record;
    record.firstSupport = static_cast<std::uint32_t>(data_.supportPoints.size());
    record.supportCount = static_cast<std::uint32_t>(parts.supportPoints.size());
    data_.supportPoints.insert(data_.supportPoints.end(), parts.supportPoints.begin(), parts.supportPoints.end());
    record.firstNormal = static_cast<std::uint32_t>(data_.faceNormals.size());
    record.normalCount = static_cast<std::uint32_t>(parts.faceNormals.size());
    data_.faceNormals.insert(data_.faceNormals.end(), parts.faceNormals.begin(), parts.faceNormals.end());
    data_.nodes.push_back(record);
    if (twoSpheres_) data_.bounds.push_back(parts.bound);
  }

  /// Leaves are in depth-first order, so a node's range is the concatenation of its descendants' ranges.
  void layOutTriangles(std::uint32_t index, const std::vector<NodeParts>& parts) {
    const auto first = static_cast<std::uint32_t>(data_.regionTriangles.size());
    const RegionNode& node = regions_[index];
    data_.regionTriangles.insert(data_.regionTriangles.end(), parts[index].triangles.begin(),
                                 parts[index].triangles.end());
    for (std::uint32_t c = 0; c < node.childCount; ++c) layOutTriangles(node.firstChild + c, parts);
    data_.nodes[index].firstTriangle = first;
    data_.nodes[index].triangleCount = static_cast<std::uint32_t>(data_.regionTriangles.size()) - first;
  }

  const RegionTree& regions_;
  const SignedDistance& solid_;
  bool twoSpheres_;
  SphereTreeData data_;
  double guard_ = 0;  // mesh unit
};

}  // namespace

SphereTreeData makeTreeData(const RegionTree& regions, const SignedDistance& solid, bool twoSpheres) {
  return Writer(regions, solid, twoSpheres).write();
}

}  // namespace cairn::builder

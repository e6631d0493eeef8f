// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/view.h"

#include "cairn/core/outward_rounding.h"

namespace cairn::builder {

ViewLink viewLink(const SphereTree& tree) {
  const SphereTreeData& data = tree.data();
  TriangleMesh mesh;  // for its bounding box
  mesh.vertices = std::vector<Vec3d>(data.vertices.begin(), data.vertices.end());
  ViewLink link{.name = tree.info().meshName,
                .origin = tree.origin(),
                .diagonal = boundsOf(mesh).diagonal(),
                .vertices = data.vertices,
                .triangles = data.triangles,
                .spheres = {},
                .regionTriangles = data.regionTriangles};
  link.spheres.reserve(data.nodes.size());
  for (const NodeData& node : data.nodes)
    link.spheres.push_back(
        {node.center, node.radius, node.error, node.innerRadius, node.parent, node.firstTriangle, node.triangleCount});
  return link;
}

ViewLink viewLink(const TriangleMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  ViewLink link{.name = mesh.name,
                .origin = bounds.center(),
                .diagonal = bounds.diagonal(),
                .vertices = {},
                .triangles = mesh.triangles,
                .spheres = {},
                .regionTriangles = {}};
  link.vertices.reserve(mesh.vertices.size());
  for (const Vec3d& vertex : mesh.vertices) link.vertices.emplace_back(vertex - link.origin);
  return link;
}

ViewLink viewLink(const TriangleMesh& mesh, const Cover& cover) {
  ViewLink link = viewLink(mesh);
  for (std::uint32_t i = 0; i < cover.balls.size(); ++i) {
    const BallProof& proof = cover.certificate.balls[i];
    link.spheres.push_back({.center = Vec3(cover.balls[i].center - link.origin),
                            .radius = static_cast<float>(cover.balls[i].radius),
                            .error = roundUp(proof.protrusion.upper),
                            .innerRadius = roundDown(proof.innerRadius),
                            .parent = i});
  }
  return link;
}

}  // namespace cairn::builder

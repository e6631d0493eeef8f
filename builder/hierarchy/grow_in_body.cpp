// SPDX-License-Identifier: GPL-3.0-or-later
#include "grow_in_body.h"

#include "hierarchy/body_frame.h"
#include "hierarchy/cut_again.h"

namespace cairn::builder {

RegionTree growInBody(const TriangleMesh& mesh, const Grow& grow) {
  const BodyFrame frame(mesh);
  const TriangleMesh body = bodyMesh(mesh, frame);
  RegionTree tree = grow(SignedDistance(body));
  cutAgain(tree, body, mesh);
  for (RegionNode& node : tree) {
    Region& region = node.region;
    region.ball = frame.outOf(region.ball);
    region.error *= frame.unit();
  }
  return tree;
}

}  // namespace cairn::builder

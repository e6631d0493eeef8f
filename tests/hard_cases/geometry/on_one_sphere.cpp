// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "geometry_cases.h"

// All samples at one distance from one point: the medial axis is that point, every four samples are co-spherical.
//
//        _.-''-._
//      .'   .    '.
//     (     c      )     a ball of 5120 faces
//      '._      _.'
//         '-..-'
namespace cairn::hard {
namespace {

Outcome run(Effort effort) {
  const builder::TriangleMesh mesh = test::meshOf(test::ball(1, effort == Effort::quick ? 4 : 5));
  builder::BuildOptions options;
  options.depth = 1;
  const auto tree = builder::buildTree(mesh, options);
  if (!tree) throw std::runtime_error(tree.error().message);
  const double radius = double(tree.value().sphere(0).radius);
  return {{{"radius of one sphere over the ball's, less 1", 100 * (radius - 1), 1, Bound::atMost, "%", "", 0}}, ""};
}

}  // namespace

HardCase onOneSphere() {
  return {"G2", "samples on one sphere", "level 1 is one sphere, its error below 1 % (proposed list)", run};
}

}  // namespace cairn::hard

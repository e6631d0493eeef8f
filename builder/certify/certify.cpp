// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "certify/cover_proof.h"
#include "certify/protrusion.h"
#include "certify/record_check.h"

namespace cairn::builder {
namespace {

NodeCertificate certifyNode(const SphereTree& tree, const NodeData& node, const SignedDistance& solid,
                            const ProtrusionTolerance& tolerance) {
  const Vec3d center = tree.origin() + Vec3d(node.center);
  const CertifiedProtrusion found = certifiedProtrusion(solid, center, node.radius, tolerance);
  NodeCertificate c;
  c.protrusionUpper = found.upper;
  c.protrusionLower = found.lower;
  c.witness = found.witness;
  c.depth = found.depth;
  c.errorHolds = node.error >= found.lower;
  c.errorProven = node.error >= found.upper;
  c.innerHolds = node.innerRadius == 0 || node.innerRadius <= found.depth + solid.roundingBound(center);
  return c;
}

/// In slices, so that a cancelled call ends soon. False when cancelled.
bool certifyNodes(const SphereTree& tree, const SignedDistance& solid, const ProgressCallback& progress,
                  std::vector<NodeCertificate>& nodes) {
  constexpr std::size_t kSlice = 256;
  const ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid);
  nodes.resize(tree.nodeCount());
  for (std::size_t first = 0; first < nodes.size(); first += kSlice) {
    const double done = static_cast<double>(first) / static_cast<double>(nodes.size());
    if (progress && !progress("certifying spheres", 0.5 + 0.5 * done)) return false;
    tbb::parallel_for(first, std::min(first + kSlice, nodes.size()),
                      [&](std::size_t i) { nodes[i] = certifyNode(tree, tree.data().nodes[i], solid, tolerance); });
  }
  return true;
}

/// False when cancelled.
bool certifyCover(const SphereTree& tree, const TriangleMesh& mesh, const ProgressCallback& progress,
                  std::vector<LevelCertificate>& levels) {
  const CoverProof proof(tree, mesh);
  // A chain of balls that ends in a leaf passes every level, so a proof for one level is a proof for all above it.
  bool reachable = false;
  for (std::uint32_t level = tree.depth() + 1; level-- > 0;) {
    const double done = static_cast<double>(tree.depth() - level) / (tree.depth() + 1);
    if (progress && !progress("certifying the cover", 0.5 * done)) return false;
    LevelCertificate& c = levels[level];
    if (!reachable) c.unreachable = proof.unreachable(level);
    reachable = !c.unreachable;
    if (!reachable) c.uncovered = proof.uncovered(level);
    c.reachableProven = reachable;
    c.coverageProven = !c.uncovered;
  }
  return true;
}

void summarize(const SphereTree& tree, const std::vector<NodeCertificate>& nodes, LevelCertificate& c) {
  const std::vector<NodeId> cut = tree.levelCut(c.level);
  double sumSq = 0;
  for (const NodeId node : cut) {
    // The nodes are kept in breadth-first order, so the cut's are found by their record.
    const auto index = static_cast<std::size_t>(&tree.node(node) - tree.data().nodes.data());
    const double upper = nodes[index].protrusionUpper;
    c.maxProtrusion = std::max(c.maxProtrusion, upper);
    sumSq += upper * upper;
  }
  c.spheres = static_cast<std::uint32_t>(cut.size());
  c.rmsProtrusion = std::sqrt(sumSq / static_cast<double>(cut.size()));
}

std::string describe(const char* what, std::uint32_t level, const UncoveredPiece& piece) {
  const std::string gap = piece.gap > 0 ? fmt::format("{:.3g} outside the nearest sphere", piece.gap)
                                        : std::string("inside, but the spheres overlap too little around it");
  return fmt::format("level {}: triangle {} is not {}: the point ({:.9g}, {:.9g}, {:.9g}) is {}", level, piece.triangle,
                     what, piece.point.x, piece.point.y, piece.point.z, gap);
}

}  // namespace

std::vector<std::string> Certificate::failures(const SphereTree& tree) const {
  std::vector<std::string> list;
  for (const LevelCertificate& c : levels) {
    if (c.uncovered) list.push_back(describe("covered", c.level, *c.uncovered));
    if (c.unreachable) list.push_back(describe("reachable through every ancestor", c.level, *c.unreachable));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeData& stored = tree.data().nodes[i];
    const NodeCertificate& c = nodes[i];
    if (!c.errorHolds)
      list.push_back(
          fmt::format("node {}: its error is {:.6g}, but the point ({:.9g}, {:.9g}, {:.9g}) of its ball is "
                      "{:.6g} from the solid",
                      i, stored.error, c.witness.x, c.witness.y, c.witness.z, c.protrusionLower));
    else if (!c.errorProven)
      list.push_back(fmt::format("node {}: its error {:.9g} is not proved, the bound is {:.9g}", i, stored.error,
                                 c.protrusionUpper));
    if (!c.innerHolds)
      list.push_back(fmt::format("node {}: its inner radius is {:.9g}, but its centre lies {:.9g} below the surface", i,
                                 stored.innerRadius, c.depth));
  }
  list.insert(list.end(), records.begin(), records.end());
  return list;
}

Result<Certificate> certify(const SphereTree& tree, const TriangleMesh& mesh, const ProgressCallback& progress) {
  Certificate certificate;
  certificate.levels.resize(tree.depth() + 1);
  for (std::uint32_t level = 0; level <= tree.depth(); ++level) certificate.levels[level].level = level;
  if (!certifyCover(tree, mesh, progress, certificate.levels)) return Error{std::string(kCancelled)};
  const SignedDistance solid(mesh);
  if (!certifyNodes(tree, solid, progress, certificate.nodes)) return Error{std::string(kCancelled)};
  certificate.records = recordFailures(tree, mesh);
  for (LevelCertificate& level : certificate.levels) summarize(tree, certificate.nodes, level);
  return certificate;
}

}  // namespace cairn::builder

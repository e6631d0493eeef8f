// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "cairn/builder/level_meshes.h"
#include "certify/cover_proof.h"
#include "certify/protrusion.h"
#include "certify/record_check.h"

namespace cairn::builder {
namespace {

/// For each node, the first node with the same ball; both share one result. Chains of nodes with one child repeat a
/// ball. A file from any source may also repeat one ball as large as the mesh, the most expensive case, at every node.
std::vector<std::size_t> firstOfSameBall(std::span<const NodeData> nodes) {
  const auto ball = [&](std::size_t i) {
    const NodeData& n = nodes[i];
    return std::tuple(n.center.x, n.center.y, n.center.z, n.radius);
  };
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order,
                    [&](std::size_t i, std::size_t j) { return std::tuple(ball(i), i) < std::tuple(ball(j), j); });
  std::vector<std::size_t> first(nodes.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool isRepeated = k > 0 && ball(order[k]) == ball(order[k - 1]);
    first[order[k]] = isRepeated ? first[order[k - 1]] : order[k];
  }
  return first;
}

void encloseProtrusion(const Vec3d& center, double radius, const SignedDistance& solid,
                       const ProtrusionTolerance& tolerance, NodeCertificate& c) {
  const CertifiedProtrusion found = certifiedProtrusion(solid, center, radius, tolerance);
  c.protrusionUpper = found.upper;
  c.protrusionLower = found.lower;
  c.witness = found.witness;
  c.depth = found.depth;
}

/// Compares the node's records of its ball with the certified results.
void judge(const NodeData& node, double rounding, NodeCertificate& c) {
  c.errorHolds = node.error >= c.protrusionLower;
  c.errorProven = node.error >= c.protrusionUpper;
  c.innerHolds = node.innerRadius == 0 || node.innerRadius <= c.depth + rounding;
}

/// Works in slices, so that a cancelled call ends soon. False when cancelled.
bool certifyNodes(const SphereTree& tree, const SignedDistance& solid, const ProgressCallback& progress,
                  std::vector<NodeCertificate>& certificates) {
  constexpr std::size_t kSlice = 256;
  const ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid);
  const std::vector<NodeData>& nodes = tree.data().nodes;
  const std::vector<std::size_t> first = firstOfSameBall(nodes);
  const auto centerOf = [&](std::size_t i) { return tree.origin() + Vec3d(nodes[i].center); };
  certificates.resize(nodes.size());
  for (std::size_t begin = 0; begin < nodes.size(); begin += kSlice) {
    const double done = static_cast<double>(begin) / static_cast<double>(nodes.size());
    if (progress && !progress("certifying spheres", 0.5 + 0.5 * done)) return false;
    const std::size_t end = std::min(begin + kSlice, nodes.size());
    tbb::parallel_for(begin, end, [&](std::size_t i) {
      if (first[i] == i) encloseProtrusion(centerOf(i), nodes[i].radius, solid, tolerance, certificates[i]);
    });
    for (std::size_t i = begin; i < end; ++i) {
      if (first[i] != i) certificates[i] = certificates[first[i]];
      judge(nodes[i], solid.roundingBound(centerOf(i)), certificates[i]);
    }
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
  for (std::uint32_t level = 1; level <= tree.levelMeshCount(); ++level)
    if (std::optional<std::string> failure = refuteLevelMesh(tree, level, mesh))
      certificate.records.push_back(*std::move(failure));
  for (LevelCertificate& level : certificate.levels) summarize(tree, certificate.nodes, level);
  return certificate;
}

}  // namespace cairn::builder

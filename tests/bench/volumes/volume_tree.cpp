// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/volume_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "volumes/protrusion.h"

namespace cairn::bench {
namespace {

using builder::ProtrusionTolerance;
using builder::SignedDistance;

// Axes with more coordinates than this belong to a surface that is not made of blocks.
constexpr std::size_t kMostCoordinates = 12;
// Queries of a certificate; spheres take some hundred. Ended here, it is less tight, which counts against the volume.
constexpr std::uint32_t kMostQueries = 4000;

double costOf(VolumeKind kind) {
  return kPairCost[static_cast<std::size_t>(kind)];
}

class Growth {
 public:
  Growth(const SignedDistance& solid, std::span<const VolumeKind> kinds, const GrowthLimits& limits)
      : solid_(solid),
        kinds_(kinds),
        limits_(limits),
        choice_(solid),
        coordinates_(vertexCoordinates(solid.mesh(), kMostCoordinates)) {}

  VolumeTree run() {
    add(builder::piecesOf(solid_.mesh()));
    for (std::uint32_t i = 0; i < tree_.nodes.size() && tree_.nodes.size() < limits_.mostNodes; ++i) {
      if (tree_.nodes[i].error <= limits_.error) continue;
      auto [below, above] = halvesOf(tree_.parts[i]);
      if (below.empty() || above.empty()) continue;
      tree_.nodes[i].firstChild = static_cast<std::uint32_t>(tree_.nodes.size());
      add(std::move(below));
      add(std::move(above));
    }
    return std::move(tree_);
  }

 private:
  void add(SurfacePart part) {
    tree_.nodes.push_back(choice_.best(part, kinds_));
    tree_.parts.push_back(std::move(part));
  }

  std::array<SurfacePart, 2> halvesOf(const SurfacePart& part) const {
    const std::vector<AxisPlane> planes = planesThrough(part, coordinates_);
    if (planes.size() == 1) return cut(part, planes[0]);
    std::array<SurfacePart, 2> best;
    double least = std::numeric_limits<double>::infinity();
    for (const AxisPlane& plane : planes) {
      std::array<SurfacePart, 2> halves = cut(part, plane);
      if (halves[0].empty() || halves[1].empty()) continue;
      const double below = choice_.weighedEstimate(halves[0], kinds_);
      const double above = choice_.weighedEstimate(halves[1], kinds_);
      const double sum = below * below + above * above;
      if (!(sum < least)) continue;
      least = sum;
      best = std::move(halves);
    }
    return best;
  }

  const SignedDistance& solid_;
  std::span<const VolumeKind> kinds_;
  GrowthLimits limits_;
  VolumeChoice choice_;
  std::array<std::vector<double>, 3> coordinates_;
  VolumeTree tree_;
};

}  // namespace

VolumeChoice::VolumeChoice(const SignedDistance& solid)
    : solid_(solid), faces_(solid.mesh()), fit_(solid), tolerance_(builder::defaultProtrusionTolerance(solid)) {
  tolerance_.maxQueries = kMostQueries;
}

VolumeNode VolumeChoice::best(const SurfacePart& part, std::span<const VolumeKind> kinds) const {
  VolumeNode best;
  double least = std::numeric_limits<double>::infinity();
  for (const VolumeKind kind : kinds) {
    const std::optional<Fit> found = fit_(kind, part);
    if (!found) continue;
    ProtrusionTolerance tolerance = tolerance_;
    tolerance.ofInterest = least / costOf(kind);  // what sticks out farther is not taken
    const double error = volumeProtrusion(solid_, faces_, found->volume, tolerance).upper;
    const double weighed = costOf(kind) * std::max(error, tolerance_.absolute);
    if (!(weighed < least)) continue;
    least = weighed;
    best = {found->volume, error, 0};
  }
  return best;
}

double VolumeChoice::weighedEstimate(const SurfacePart& part, std::span<const VolumeKind> kinds) const {
  double least = std::numeric_limits<double>::infinity();
  for (const VolumeKind kind : kinds)
    if (const std::optional<Fit> fit = fit_(kind, part))
      least = std::min(least, costOf(kind) * std::max(fit->estimate, tolerance_.absolute));
  return least;
}

VolumeTree growTree(const SignedDistance& solid, std::span<const VolumeKind> kinds, const GrowthLimits& limits) {
  return Growth(solid, kinds, limits).run();
}

std::vector<std::uint32_t> cutAt(const VolumeTree& tree, double error) {
  std::vector<std::uint32_t> cut, open{0};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    const VolumeNode& n = tree.nodes[node];
    if (n.error <= error || n.firstChild == 0) {
      cut.push_back(node);
    } else {
      open.push_back(n.firstChild + 1);
      open.push_back(n.firstChild);
    }
  }
  return cut;
}

}  // namespace cairn::bench

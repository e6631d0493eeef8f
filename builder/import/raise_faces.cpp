// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/raise_faces.h"

#include <algorithm>
#include <map>

namespace cairn::builder {
namespace {

/// A plane beside a vertex, and how far the vertex has to move along its normal at least.
struct Demand {
  Vec3d normal;
  double least = 0;
  double weight = 0;  ///< how much of its normal is in the move
};

/// The shortest move that meets all demands (Hildreth's method).
Vec3d shortestMove(std::vector<Demand>& demands, double amount) {
  constexpr int kMaxRounds = 1000;
  constexpr double kExact = 1e-6, kMostAmounts = 8;
  Vec3d move;
  for (int round = 0; round < kMaxRounds; ++round) {
    double worst = 0;
    for (Demand& d : demands) {
      const double missing = d.least - dot(d.normal, move);
      const double change = std::max(missing, -d.weight);
      d.weight += change;
      move += d.normal * change;
      worst = std::max(worst, missing);
    }
    if (worst <= kExact * amount) break;
  }
  const double reach = length(move);
  return reach > kMostAmounts * amount ? move * (kMostAmounts * amount / reach) : move;
}

}  // namespace

void raiseFaces(TriangleMesh& mesh, const std::vector<std::uint32_t>& raised, double amount) {
  std::map<std::uint32_t, std::vector<Demand>> demands;  // of the vertices that move
  for (const std::uint32_t t : raised)
    for (const std::uint32_t v : mesh.triangles[t]) demands[v];
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3d normal = normalized(cross(b - a, c - a));
    const bool isRaised = std::binary_search(raised.begin(), raised.end(), t);
    for (const std::uint32_t v : mesh.triangles[t])
      if (const auto found = demands.find(v); found != demands.end())
        found->second.push_back({normal, isRaised ? amount : 0, 0});
  }
  for (auto& [v, list] : demands) mesh.vertices[v] += shortestMove(list, amount);
}

}  // namespace cairn::builder

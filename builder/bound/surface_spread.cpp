// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/surface_spread.h"

#include <algorithm>
#include <limits>

#include "balls/piece.h"

namespace cairn::builder {
namespace {

/// The corners of the mesh's triangles after the longest have been bisected, without repetitions: neighbours compute
/// the same midpoints bit for bit.
std::vector<Vec3d> candidatesOn(const TriangleMesh& mesh, std::size_t pieceCount) {
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, pieceCount);
  std::vector<Vec3d> corners;
  for (const Piece& piece : pieces) corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
  std::sort(corners.begin(), corners.end(), [](const Vec3d& a, const Vec3d& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

std::vector<Vec3d> spreadOverSurface(const TriangleMesh& mesh, std::size_t count, const KeepGoing& keepGoing) {
  const std::vector<Vec3d> candidates = candidatesOn(mesh, 16 * count);
  std::vector<double> toChosen(candidates.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3d> chosen;
  // The first is the candidate farthest from the middle; candidates are sorted, so ties have one answer.
  Vec3d last = boundsOf(mesh).center();
  for (bool first = true; chosen.size() < count && keepGoing(); first = false) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      toChosen[i] = std::min(toChosen[i], lengthSq(candidates[i] - last));
      if (toChosen[i] > toChosen[farthest]) farthest = i;
    }
    if (!(toChosen[farthest] > 0)) break;
    last = candidates[farthest];
    chosen.push_back(last);
    if (first) std::fill(toChosen.begin(), toChosen.end(), std::numeric_limits<double>::infinity());
  }
  return chosen;
}

}  // namespace cairn::builder

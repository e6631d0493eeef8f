// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_again.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace cairn::builder {

namespace {

/// A piece of some region; the flag says that no region below has it cut further.
struct Wanted {
  Piece* piece = nullptr;
  bool ofLeaf = false;
};

bool before(const Piece& a, const Piece& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &p = a.corners[i], &q = b.corners[i];
    if (!(p == q)) return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  }
  return false;
}

struct Before {
  bool operator()(const Wanted& a, const Wanted& b) const { return before(*a.piece, *b.piece); }
  bool operator()(const Wanted& a, const Piece& b) const { return before(*a.piece, b); }
  bool operator()(const Piece& a, const Wanted& b) const { return before(a, *b.piece); }
};

/// The pieces of all regions; those of triangle t start at `first[t]`.
struct WantedPieces {
  std::vector<Wanted> list;
  std::vector<std::size_t> first;
};

WantedPieces wantedBySource(RegionTree& tree, std::size_t triangles) {
  WantedPieces wanted{{}, std::vector<std::size_t>(triangles + 1, 0)};
  for (const RegionNode& node : tree)
    for (const Piece& piece : node.region.pieces) ++wanted.first[piece.source + 1];
  for (std::size_t t = 0; t < triangles; ++t) wanted.first[t + 1] += wanted.first[t];
  wanted.list.resize(wanted.first[triangles]);
  std::vector<std::size_t> next(wanted.first.begin(), wanted.first.end() - 1);
  for (RegionNode& node : tree)
    for (Piece& piece : node.region.pieces) wanted.list[next[piece.source]++] = {&piece, node.childCount == 0};
  return wanted;
}

/// A piece, and the piece that the same cuts make of the same triangle in the other mesh.
struct Twins {
  Piece from, to;
};

/// Makes all cuts from a whole triangle down to its pieces, and replaces the pieces by their twins.
void cutTriangle(const Twins& whole, std::span<Wanted> wanted) {
  std::sort(wanted.begin(), wanted.end(), Before());
  Pieces cut(wanted.size());
  std::vector<Twins> left{whole};
  while (!left.empty()) {
    const Twins twins = left.back();
    left.pop_back();
    const auto [begin, end] = std::equal_range(wanted.begin(), wanted.end(), twins.from, Before());
    for (auto w = begin; w != end; ++w) cut[static_cast<std::size_t>(w - wanted.begin())] = twins.to;
    if (std::any_of(begin, end, [](const Wanted& w) { return w.ofLeaf; })) continue;
    assert(longestEdgeSq(twins.from) > 0);
    const std::size_t edge = longestEdge(twins.from);
    const auto from = cutAt(twins.from, edge), to = cutAt(twins.to, edge);
    left.push_back({from[0], to[0]});
    left.push_back({from[1], to[1]});
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) *wanted[i].piece = cut[i];
}

}  // namespace

void cutAgain(RegionTree& tree, const TriangleMesh& from, const TriangleMesh& mesh) {
  if (tree.empty()) return;
  WantedPieces wanted = wantedBySource(tree, mesh.triangles.size());
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(mesh.triangles.size()), [&](std::uint32_t t) {
    const std::span<Wanted> ofThis(wanted.list.data() + wanted.first[t], wanted.list.data() + wanted.first[t + 1]);
    cutTriangle({{from.corners(t), t}, {mesh.corners(t), t}}, ofThis);
  });
}

}  // namespace cairn::builder

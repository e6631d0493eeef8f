// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cairn/core/vec3.h"
#include "rockfall/case/map_source.h"
#include "rockfall/case/materials.h"
#include "rockfall/case/place_set.h"

namespace cairn::rockfall {

enum class RockKind : std::uint8_t { angular, slabby, rounded };

/// Rocks of one kind, generated from seeds.
struct MadeRocks {
  RockKind kind = RockKind::angular;
  bool concave = false;
  std::uint32_t variants = 1;  ///< different shapes, each with a tree of its own
};

/// One shape for all rocks, from a mesh file; the file's unit does not matter.
struct MeshRocks {
  std::string file;
};

/// The share of rocks, by number, that pass a sieve: piecewise linear from 0 to 1. The sieve size of a rock is the
/// middle one of its three extents along its principal axes, metres.
struct SieveCurve {
  struct Point {
    double sizeM = 0, share = 0;
  };
  std::vector<Point> points;

  /// Returns the size that the share `u` (0 to 1) of all rocks passes.
  double sizeAt(double u) const;
  double smallest() const { return points.front().sizeM; }
  double largest() const { return points.back().sizeM; }
};

/// Place and motion of the rocks of a group at their release.
struct Release {
  std::array<MapPoint, 2> boxM{};  ///< opposite corners on the map; a place is drawn evenly from it
  std::optional<MapSource> map;    ///< in place of the box
  PlaceSet places;                 ///< of the map, once it is read; not empty: in place of the box
  double aboveGroundM = 0;         ///< of the rock's lowest point
  Vec3d velocityMPerS{};
  Vec3d velocitySpreadMPerS{};  ///< of each component to either side, drawn evenly
  /// Turns about the map's x, then y, then z. Before them a rock lies flat: its axis of least inertia (the long one)
  /// along x, that of greatest inertia upright. Nothing: any orientation, all alike likely.
  std::optional<Vec3d> orientationDeg;
  double intervalS = 0;  ///< between one rock and the next; 0: all at once
};

struct RockGroup {
  std::uint32_t count = 1;     ///< of a group with `perPlace`, once the map is read
  std::uint32_t perPlace = 0;  ///< so many from each point or cell of the release's map; 0: `count` in all
  bool meetsRocks = true;      ///< false: no other rock is in its way, nor are its own pieces
  std::variant<MadeRocks, MeshRocks> source;
  SieveCurve sieve;
  std::uint32_t treeDepth = 3;  ///< levels below the root
  double densityKgPerM3 = 2600;
  MaterialId material = 0;
  Release release;
};

/// Of one group.
inline constexpr std::uint64_t kMaxRocks = 100000;

std::vector<RockGroup> readRocks(const Value& value, const Materials& materials);

}  // namespace cairn::rockfall

// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cairn/core/budget.h"
#include "cairn/core/surface_ray.h"
#include "kernel/contact_limits.h"
#include "kernel/crossings.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// A point of one body that lies inside the other, or on its surface.
struct OverlapPoint {
  Vec3 position;  ///< pair frame
  bool isOfA = false;
  bool isCrossing = false;
  std::uint32_t feature = 0;  ///< the vertex; for a crossing, the edge
  std::uint32_t face = 0;     ///< for a crossing: the other body's face
  std::uint32_t region = 0;
};

/// A connected piece of the overlap of two bodies.
struct OverlapRegion {
  std::span<const OverlapPoint> points;
  /// The vector area of A's surface inside B, pair frame: how fast the overlap grows as A moves.
  Vec3 area;
  float sum = 0;  ///< of the lengths of the parts of `area`
};

/// Finds which points of two bodies are inside each other, and which of them form one region. A region starts where
/// surfaces cross. It includes the vertices on the inner sides, and all vertices joined to these by edges without a
/// crossing.
class OverlapRegions {
 public:
  /// Sorts `crossings` and removes duplicates. A vertex is inside if the crossings of its edges say so. If they
  /// disagree, or there are none, it is inside if a contact explains it; else a ray decides. Empty when the budget does
  /// not suffice for the rays. Valid until the next call.
  std::optional<std::span<const OverlapRegion>> find(const SurfacePair& surfaces, const ContactLimits& limits,
                                                     std::span<const FeatureContact> contacts,
                                                     std::vector<Crossing>& crossings, Budget& budget);

 private:
  // The arguments of `find`, for its duration.
  struct Question {
    const SurfacePair& surfaces;
    const ContactLimits& limits;
    std::span<const FeatureContact> contacts;
    std::span<const Crossing> crossings;
    Budget& budget;

    const PlacedSurface& side(bool isOfA) const { return isOfA ? surfaces.a : surfaces.b; }
    const SurfaceEdge& edgeOf(const Crossing& c) const { return side(c.isEdgeOfA).features().edges()[c.edge]; }
    std::span<const Crossing> crossingsOf(bool isOfA, std::uint32_t edge) const;
  };

  void joinCrossings(const Question& question);
  void gather(const Question& question);
  Vec3 areaBetween(const Question& question, std::size_t at) const;
  void flood(const Question& question);
  void seed(const Question& question, const Crossing& crossing, std::uint32_t vertex, std::uint32_t region);
  std::uint32_t visit(const Question& question, bool isOfA, std::uint32_t vertex, std::uint32_t region);
  bool isInside(const Question& question, bool isOfA, std::uint32_t vertex, const Vec3& place);
  std::uint32_t rootOf(std::uint32_t region);
  void join(std::uint32_t x, std::uint32_t y);

  std::vector<std::uint32_t> parent_;  // union-find of regions, by crossing
  std::vector<std::pair<std::uint64_t, std::uint32_t>> trianglePairs_;
  std::vector<OverlapPoint> points_;
  struct Area {
    Vec3 area;
    float sum = 0;
  };
  static void addArea(Area& area, const Vec3& part);
  std::vector<Area> areas_;  // by crossing that is the root of its region
  bool isCut_ = false;       // the budget did not suffice for a ray
  Box nearCrossings_;        // box around the crossings, grown by a contact distance
  std::vector<OverlapRegion> regions_;
  std::vector<std::uint32_t> waiting_;  // points whose neighbours are still to be visited
  // By vertex of A and of B: its point's index or kOutside, valid if `search` equals `search_`.
  struct Visit {
    std::uint32_t search = 0, point = 0;
  };
  std::vector<Visit> visited_[2];
  std::uint32_t search_ = 0;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet

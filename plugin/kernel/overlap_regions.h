// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
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
  std::uint32_t feature = 0;  ///< the vertex, or of a crossing the edge
  std::uint32_t face = 0;     ///< of a crossing: the other body's
  std::uint32_t region = 0;
};

/// What belongs together: a piece of the overlap of two bodies.
struct OverlapRegion {
  std::span<const OverlapPoint> points;
  /// The vector area of A's surface inside B, pair frame: by how much the overlap grows when A moves.
  Vec3 area;
  float sum = 0;  ///< of the lengths of what it is made of
};

/// Which points of two bodies are inside each other, and which of these belong together: where surfaces cross, the
/// vertices on the inner sides, and all that these are joined with by edges which do not cross.
class OverlapRegions {
 public:
  /// `crossings` are sorted and made unique. Vertices are where crossings of their edges say. Where these do not
  /// agree, or there are none, what a contact explains is inside; of others a ray is asked. Valid until the next call.
  /// Charges the rays, whatever is left of the budget.
  std::span<const OverlapRegion> find(const SurfacePair& surfaces, const ContactLimits& limits,
                                      std::span<const FeatureContact> contacts, std::vector<Crossing>& crossings,
                                      Budget& budget);

 private:
  // What is asked about; lives as long as `find` runs.
  struct Question {
    const SurfacePair& surfaces;
    const ContactLimits& limits;
    std::span<const FeatureContact> contacts;
    std::span<const Crossing> crossings;

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

  std::vector<std::uint32_t> parent_;  // of regions, by crossing
  std::vector<std::pair<std::uint64_t, std::uint32_t>> trianglePairs_;
  std::vector<OverlapPoint> points_;
  struct Area {
    Vec3 area;
    float sum = 0;
  };
  static void addArea(Area& area, const Vec3& part);
  std::vector<Area> areas_;  // by crossing, where that is its region's root
  std::uint32_t asked_ = 0;  // rays
  Box around_;               // the crossings, and a contact distance more
  std::vector<OverlapRegion> regions_;
  std::vector<std::uint32_t> waiting_;  // points whose neighbours are to be visited
  // By vertex of A and of B: the point it is, or kOutside, in the search that its stamp names.
  struct Visit {
    std::uint32_t search = 0, point = 0;
  };
  std::vector<Visit> visited_[2];
  std::uint32_t search_ = 0;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "surface/surface_distance.h"

namespace cairn::builder {

/// Simplifies a closed mesh by edge collapses. The next collapse is always the one that leaves the least greatest
/// distance to a source, both ways. A quadric error, in contrast, loses thin parts first: they have little area.
///
/// Distances are sampled: points of the source follow the triangle that is nearest to them, and new triangles are
/// looked at in some of their points. So the result wants a certificate; see `meshDistance`. A collapse after which the
/// surface would cut through itself is left out.
///
///     auto collapse = CollapseByDistance::create(source, source, SurfaceDistance(source));
///     if (collapse && collapse->collapseTo(400, keepGoing)) use(collapse->mesh());
class CollapseByDistance {
 public:
  /// `start`: a closed mesh near the source. `distanceToSource` must outlive this. Null for a pinched vertex.
  static std::unique_ptr<CollapseByDistance> create(const TriangleMesh& start, const TriangleMesh& source,
                                                    const SurfaceDistance& distanceToSource);
  ~CollapseByDistance();

  /// Collapses edges until at most so many triangles are left, or none can be collapsed. False when cancelled.
  bool collapseTo(std::uint32_t triangles, const KeepGoing& keepGoing);
  /// The mesh as it is now, in the frame of the source.
  TriangleMesh mesh() const;

 private:
  struct Impl;
  explicit CollapseByDistance(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::builder

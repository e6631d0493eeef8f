// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "cairn/builder/cover.h"
#include "certify/progress_watch.h"
#include "flat/minimax_cover.h"
#include "hierarchy/body_frame.h"

namespace cairn::builder {

/// How much a set is worked at.
enum class Effort : std::uint8_t { quick, full };

/// Makes covers of one mesh. The search runs in the body's own frame; radii are settled, and all is certified, on the
/// mesh as it is. Keeps references.
class FlatCover {
 public:
  /// Precondition: options in range, `checkMesh(mesh)`.
  FlatCover(const TriangleMesh& mesh, const CoverOptions& options, const std::optional<MirrorPlane>& mirror,
            const ProgressCallback& progress);

  Result<Cover> run();

 private:
  /// So many spheres, with their certificate.
  Result<Cover> make(std::uint32_t count, Effort effort);
  /// Radii on the mesh as it is, for balls around centres found in the body.s frame.
  SphereSet settled(const FlatSet& set, bool keepRadii) const;
  /// The set, or one that covers with less volume outside, settled.
  SphereSet leanest(const FlatSet& set, const FlatProblem& problem, const FlatPoints& points) const;
  /// In the mesh's frame.
  FlatSet outOfBody(FlatSet set) const;
  FlatSet search(const FlatProblem& problem, const FlatPoints& points) const;

  const TriangleMesh& mesh_;
  const CoverOptions& options_;
  std::optional<MirrorPlane> mirror_;
  ProgressWatch watch_;
  KeepGoing keepGoing_;
  BodyFrame frame_;
  TriangleMesh body_;  // the mesh in that frame
  SignedDistance bodySolid_, solid_;
};

}  // namespace cairn::builder

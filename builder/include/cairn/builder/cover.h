// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/certify_balls.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// The quality that a flat set of spheres optimises. Every set has the same certificate, whatever its objective.
enum class Objective : std::uint8_t {
  outer,     ///< covers the surface; sticks out of the solid as little as can be
  balanced,  ///< the worst of what sticks out and what is left out of the surface is as small as can be
  inner,     ///< every ball lies in the solid; leaves out as little of the surface as can be
  volume,    ///< covers the surface; the union's volume outside the solid is as small as can be
};

/// The options of `coverMesh`.
struct CoverOptions {
  /// How many spheres, exactly; 1..`kMaxCoverSpheres`. Nothing: the fewest found that keep `maxError`.
  std::optional<std::uint32_t> spheres = 8;
  /// The error to keep (see `Cover::error`), mesh unit, above 0. One of the two is given.
  std::optional<double> maxError;
  Objective objective = Objective::outer;  ///< the quality to optimise
  /// Keep a mirror plane the mesh has: spheres come in pairs and on the plane.
  bool symmetric = false;
  std::uint64_t seed = 1;  ///< of the random starts
  bool quick = false;      ///< spend little on the search of a given number, to estimate its error
};
/// Largest number of spheres of a flat set.
inline constexpr std::uint32_t kMaxCoverSpheres = 4096;

/// A plane {x : normal . x = offset}, mesh frame; `normal` is a unit vector.
struct MirrorPlane {
  Vec3d normal;          ///< unit vector
  double offset = 0;     ///< distance from the mesh's origin along `normal`, mesh unit
  double deviation = 0;  ///< proved: no point of the mirrored surface is farther from the surface (mesh unit)
};
/// A mesh counts as mirrored by a plane up to this deviation, as a fraction of its bounding box's diagonal.
inline constexpr double kMirrorTolerance = 1e-3;

/// A flat set of spheres: mesh frame and unit.
struct Cover {
  std::vector<Ball> balls;            ///< the spheres
  BallsCertificate certificate;       ///< the proof about them
  std::optional<MirrorPlane> mirror;  ///< the plane kept

  /// The proved error that the objective minimises: `sticksOut` of outer and volume, `leavesSurface` of inner, the
  /// larger of both for balanced.
  double error(Objective objective) const;
};

/// Covers a solid by a flat set of spheres for one objective, with its certificate. Outer and volume sets are proved to
/// cover the surface, balls of inner sets to lie in the solid.
///
/// Fails for options out of range, for a mesh `checkMesh` refuses, for a mesh without a mirror plane when one is to be
/// kept, when no set of `kMaxCoverSpheres` keeps the error, and with `kCancelled`. The same mesh, options and seed give
/// the same bits for any number of threads. Seconds for 64 spheres.
Result<Cover> coverMesh(const TriangleMesh& mesh, const CoverOptions& options, const ProgressCallback& progress = {});

/// A mirror plane of the mesh, the most exact one found among planes through its centre of mass; nothing when none is
/// within `kMirrorTolerance`. Precondition: `checkMesh(mesh)`.
std::optional<MirrorPlane> mirrorPlaneOf(const TriangleMesh& mesh);

/// The objective with this name. Fails for any other name, and lists the names.
Result<Objective> parseObjective(const std::string& name);
/// The name of an objective, as on the command line.
const char* objectiveName(Objective objective);
/// The names of all objectives.
std::vector<std::string> objectiveNames();

/// One line `x y z r error inner` a sphere: centre, radius, certified protrusion, inner radius; mesh frame and unit,
/// the digits to give back the same doubles.
std::string coverText(const Cover& cover);

}  // namespace cairn::builder

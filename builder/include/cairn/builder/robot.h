// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/cover.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/robot_model.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// How many spheres the links of a robot get. Exactly one of `perLink`, `total` and `maxError` is given.
struct RobotBudget {
  std::optional<std::uint32_t> perLink;         ///< for each link, exactly
  std::map<std::string, std::uint32_t> ofLink;  ///< for these links instead, with `perLink`
  /// For all links together, at most: the next spheres go where the certified error falls most a sphere. A few stay
  /// over where meshes that share a set cannot have one each.
  std::optional<std::uint32_t> total;
  std::optional<double> maxError;  ///< the fewest found for each mesh that keep this error, metres
};

/// Options of `fitRobot`.
struct RobotOptions {
  RobotBudget budget;                                     ///< how many spheres
  Objective objective = Objective::outer;                 ///< what spheres are good at
  bool primitives = false;                                ///< boxes and cylinders become spheres too
  std::map<std::string, std::filesystem::path> packages;  ///< folders of ROS packages
  std::uint64_t seed = 1;                                 ///< of all random choices
};

/// What the certificate of a part is about.
enum class SolidSource : std::uint8_t {
  original,  ///< the mesh as it is
  repaired,  ///< the mesh after `repair`
  wrapped,   ///< a closed skin around the mesh, after `wrap`
  box,       ///< exactly
  cylinder,  ///< a prism of `kPrismSides` sides around it (inside it for the objective inner)
};
/// Sides of the prism of a cylinder: it stands 0.2 % of the radius off.
inline constexpr std::uint32_t kPrismSides = 48;

/// A solid whose spheres one or more parts share. In the frame of the shape, scaled by the scale's absolute values.
struct RobotSolid {
  std::string name;      ///< of the file or the shape, for reports
  TriangleMesh solid;    ///< what spheres are fitted to and certified against
  TriangleMesh surface;  ///< what the URDF names: the mesh as read; of a cylinder the prism inside it
  SolidSource source = SolidSource::original;  ///< what `solid` was made of
  std::string changes;                         ///< what a repair changed
  double offOriginal = 0;  ///< no point of the solid's surface is farther from the surface named; metres
};

/// A `<collision>` with its spheres.
struct RobotPart {
  std::uint32_t collision = 0;         ///< its place in the link
  std::optional<std::uint32_t> solid;  ///< nothing: a primitive that is kept as it is
  Vec3d signs{1, 1, 1};                ///< the solid is mirrored by these
  double deviation = 0;                ///< no point of this part's surface is farther from the mirrored surface; metres
  std::vector<Ball> balls;             ///< link's frame; of a sphere that is kept, the sphere
  std::vector<double> errors;  ///< of each ball that was fitted: no point of it is farther out; at most `sticksOut`
  double sticksOut = 0;      ///< proved: no point of a ball is farther from what the URDF names (see `source`); metres
  double leavesOut = 0;      ///< proved: no point of its surface is farther from the balls; metres
  bool covered = false;      ///< proved: the balls cover the surface of the solid
  bool coversNamed = false;  ///< proved: they cover the surface that the URDF names too
};

/// A robot with its spheres.
struct FittedRobot {
  std::vector<RobotSolid> solids;             ///< each once, however many parts share it
  std::vector<std::vector<RobotPart>> links;  ///< parts of each link of the model, in the order of its collisions

  /// Spheres of a link: those of all its parts.
  std::vector<Ball> ballsOf(std::uint32_t link) const;
  /// The shape of a link that is kept and is no sphere, if there is one: formats of spheres alone cannot hold it.
  const RobotPart* keptShape(const RobotModel& model, std::uint32_t link) const;
};

/// Covers the collision meshes of a robot by spheres, with proofs. A mesh that bounds no solid is repaired, and wrapped
/// where that fails. Meshes that are mirror images or copies of each other, by scale or file, share one set. With the
/// objectives outer and volume spheres of repaired and wrapped meshes grow until they cover the triangles of the file
/// too, where less than the skin's distance is missing.
///
/// Fails with one sentence for meshes that are not found or read, budgets that give a mesh no sphere, and with
/// `kCancelled`. Parallel over meshes; the same input and seed give the same bits for any number of threads.
Result<FittedRobot> fitRobot(const RobotModel& model, const std::filesystem::path& urdf, const RobotOptions& options,
                             const ProgressCallback& progress = {});

/// Options of `checkSelfCollision`.
struct SelfCollisionOptions {
  std::uint32_t poses = 200;  ///< joint positions that are tried: the default one, then uniformly distributed ones
  std::uint64_t seed = 1;     ///< of the joint positions
};

/// Two links in the poses tried.
struct LinkPairCount {
  std::uint32_t first = 0, second = 0;  ///< links
  std::uint32_t spheres = 0;            ///< poses in which their spheres (or primitives kept) touch
  std::uint32_t meshes = 0;             ///< poses in which surfaces of the URDF's shapes meet
  std::uint32_t falsely = 0;            ///< poses in which spheres touch and surfaces do not
  std::uint32_t missed = 0;             ///< poses in which surfaces meet and no sphere touches
};

/// Links against each other.
struct SelfCollisions {
  std::uint32_t poses = 0;                                        ///< joint positions tried
  std::uint32_t pairsTried = 0;                                   ///< pairs of links tried in each
  std::vector<std::pair<std::uint32_t, std::uint32_t>> adjacent;  ///< parent and child, which were not tried
  std::vector<LinkPairCount> touching;  ///< pairs that touch in some pose, by spheres or surfaces

  /// Pairs whose surfaces meet in all poses tried: no motion can avoid it.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> always() const;
};

/// Compares what spheres say with what the surfaces say, which FCL (Pan et al. 2012) intersects independently, at
/// sampled positions of all active joints. Where all parts are `coversNamed`, `missed` is 0 by proof. Spheres of the
/// URDF stand in FCL as triangles inside them. Fails with `kCancelled`. Parallel, deterministic.
Result<SelfCollisions> checkSelfCollision(const RobotModel& model, const FittedRobot& fitted,
                                          const SelfCollisionOptions& options, const ProgressCallback& progress = {});

/// What the writers write about.
struct RobotOutput {
  const RobotModel& model;              ///< must outlive this
  const FittedRobot& fitted;            ///< likewise
  const SelfCollisions& collisions;     ///< likewise
  std::string urdf;                     ///< name of the URDF written, for formats that refer to it
  std::vector<std::string> toolFrames;  ///< links at which tools are; empty: all links without children
};

/// The URDF with `<sphere>` collisions instead of those that were fitted; all else is as it was.
Result<std::string> robotUrdfText(const RobotOutput& output);
/// An SRDF: `link_sphere_approximation` as MoveIt's srdfdom reads it, and `disable_collisions` of adjacent pairs and of
/// those that always meet. Fails for shapes that are kept.
Result<std::string> robotSrdfText(const RobotOutput& output);
/// A robot configuration of cuRobo (keys of its template.yml). Fails for shapes that are kept.
Result<std::string> robotCuroboText(const RobotOutput& output);
/// An XRDF 1.0 of NVIDIA Isaac. Fails for shapes that are kept.
Result<std::string> robotXrdfText(const RobotOutput& output);
/// A model for MuJoCo (MJCF): bodies, joints, masses, spheres and kept shapes, fixed to the world at its root. Fails
/// for planar joints, floating ones elsewhere than at a root `world`, and moving links without any mass.
Result<std::string> robotMjcfText(const RobotOutput& output);

}  // namespace cairn::builder

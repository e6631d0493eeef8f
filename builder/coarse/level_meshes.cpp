// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/level_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/builder/simplify.h"
#include "cairn/core/outward_rounding.h"
#include "coarse/collapse_by_distance.h"
#include "coarse/mesh_distance.h"

namespace cairn::builder {
namespace {

/// Triangles of a level's mesh for each sphere of the level: a sphere and its patch then say about as much, and a pair
/// of patches costs about as much as opening a pair of spheres.
constexpr std::uint32_t kTrianglesPerSphere = 6;
/// A level has a mesh of its own where it has at most this part of the source's triangles.
constexpr double kMinSaving = 0.7;
/// Simplification by quadric error goes first down to so many triangles, and to so many for each of the finest level's.
/// It is far quicker, and loses next to nothing there.
constexpr std::uint32_t kMinStart = 20'000, kStartFactor = 4;
/// Distances are enclosed to this part of the mesh's diagonal.
constexpr double kResolution = 1e-5;
/// A mesh that cuts through itself is simplified further, by so much each time, and so often.
constexpr double kFurther = 0.97;
constexpr int kMaxTries = 8;

/// Adding the origin to a vertex rounds by half a unit in the last place of either, for each of three axes.
double roundingOf(const Bounds& bounds, const Vec3d& origin) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis]), std::abs(origin[axis])});
  return 8 * std::numeric_limits<double>::epsilon() * largest;
}

TriangleMesh placed(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3d& origin) {
  TriangleMesh mesh;
  for (const Vec3& v : vertices) mesh.vertices.push_back(origin + Vec3d(v));
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

LevelMesh inTreeFrame(const TriangleMesh& mesh, const Vec3d& origin) {
  LevelMesh level;
  for (const Vec3d& v : mesh.vertices) level.vertices.emplace_back(v - origin);
  level.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  return level;
}

class Maker {
 public:
  Maker(const TriangleMesh& mesh, const Vec3d& origin, const ProgressCallback& progress)
      : mesh_(mesh), origin_(origin), distance_(mesh), bounds_(boundsOf(mesh)), progress_(progress) {}

  Result<std::vector<LevelMesh>> make(std::span<const std::uint32_t> spheres) {
    const std::vector<std::uint32_t> wanted = triangleCounts(spheres);
    if (wanted.empty()) return std::vector<LevelMesh>();
    const Result<TriangleMesh> start = startMesh(std::max(kMinStart, wanted.back() * kStartFactor));
    if (!start) return start.error();
    collapse_ = CollapseByDistance::create(start.value(), mesh_, distance_);
    if (!collapse_)
      return Error{"the mesh has a vertex where two surfaces only touch; separate it, or build without level meshes"};
    std::vector<LevelMesh> levels(wanted.size());
    for (std::size_t i = wanted.size(); i-- > 0;) {
      std::optional<LevelMesh> level = simplifyTo(wanted[i]);
      if (isCancelled_) return Error{std::string(kCancelled)};
      // Each shell keeps four triangles: many shells may leave nothing to save.
      if (level && saves(level->triangles.size()))
        levels[i] = *std::move(level);
      else if (i + 1 < levels.size())
        levels[i] = levels[i + 1];
      else
        levels.pop_back();
    }
    return levels;
  }

 private:
  bool saves(std::uint64_t triangles) const {
    return static_cast<double>(triangles) <= kMinSaving * static_cast<double>(mesh_.triangles.size());
  }

  std::vector<std::uint32_t> triangleCounts(std::span<const std::uint32_t> spheres) const {
    std::vector<std::uint32_t> counts;
    for (const std::uint32_t count : spheres) {
      const std::uint64_t triangles = std::uint64_t{kTrianglesPerSphere} * count;
      if (!saves(triangles)) break;
      counts.push_back(static_cast<std::uint32_t>(triangles));
    }
    return counts;
  }

  /// The source where quadric errors would cut it through itself.
  Result<TriangleMesh> startMesh(std::uint32_t triangles) {
    if (mesh_.triangles.size() <= triangles) return mesh_;
    const Result<TriangleMesh> start =
        simplify(mesh_, triangles, [&](std::string_view, double done) { return report(0.3 * done); });
    if (!start && isCancelled_) return start.error();
    return start ? start.value() : mesh_;
  }

  bool report(double done) {
    done_ = std::max(done_, done);
    isCancelled_ = isCancelled_ || (progress_ && !progress_("simplifying for the levels", done_));
    return !isCancelled_;
  }

  /// Empty when cancelled, or when the mesh would cut through itself.
  std::optional<LevelMesh> simplifyTo(std::uint32_t triangles) {
    for (int i = 0; i < kMaxTries; ++i, triangles = static_cast<std::uint32_t>(kFurther * triangles)) {
      if (!collapse_->collapseTo(triangles, [&] { return report(done_); })) return {};
      LevelMesh level = inTreeFrame(collapse_->mesh(), origin_);
      const TriangleMesh mesh = placed(level.vertices, level.triangles, origin_);
      if (!checkMesh(mesh)) continue;
      const double diagonal = bounds_.diagonal();
      level.distance =
          roundUp(meshDistance(mesh, mesh_, distance_, kResolution * diagonal).upper + roundingOf(bounds_, origin_));
      report(done_ + 0.5 * (1 - done_));
      return level;
    }
    return {};
  }

  const TriangleMesh& mesh_;
  Vec3d origin_;
  SurfaceDistance distance_;
  Bounds bounds_;
  const ProgressCallback& progress_;
  double done_ = 0;
  bool isCancelled_ = false;
  std::unique_ptr<CollapseByDistance> collapse_;
};

}  // namespace

Result<std::vector<LevelMesh>> makeLevelMeshes(const TriangleMesh& mesh, const Vec3d& origin,
                                               std::span<const std::uint32_t> spheres,
                                               const ProgressCallback& progress) {
  return Maker(mesh, origin, progress).make(spheres);
}

TriangleMesh levelMeshOf(const SphereTree& tree, std::uint32_t level) {
  const LevelMesh& own = tree.levelMesh(level);
  TriangleMesh mesh = placed(own.vertices, own.triangles, tree.origin());
  mesh.name = tree.info().meshName;
  return mesh;
}

TriangleMesh sourceMeshOf(const SphereTree& tree) {
  TriangleMesh mesh = placed(tree.vertices(), tree.triangles(), tree.origin());
  mesh.name = tree.info().meshName;
  return mesh;
}

std::optional<std::string> refuteLevelMesh(const SphereTree& tree, std::uint32_t level, const TriangleMesh& mesh) {
  const TriangleMesh coarse = levelMeshOf(tree, level);
  if (const Status s = checkMesh(coarse); !s) return fmt::format("level mesh {}: {}", level, s.error().message);
  const double claimed = double(tree.levelMesh(level).distance), diagonal = boundsOf(mesh).diagonal();
  const MeshDistance found = meshDistance(coarse, mesh, SurfaceDistance(mesh), kResolution * diagonal);
  if (found.upper <= claimed) return {};
  if (found.lower > claimed)
    return fmt::format("level mesh {}: its distance is {:.6g}, but a point is {:.6g} away", level, claimed,
                       found.lower);
  return fmt::format("level mesh {}: its distance {:.9g} is not proved, the bound is {:.9g}", level, claimed,
                     found.upper);
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/collect_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "robot/mesh_paths.h"
#include "robot/mirror_match.h"
#include "robot/parallel_jobs.h"
#include "robot/primitive_meshes.h"
#include "robot/robot_solid.h"

namespace cairn::builder {
namespace {

/// A file at a scale without signs.
struct SurfaceSource {
  std::filesystem::path path;
  std::array<double, 3> factors{};
  std::string user;  ///< the first link that uses it, for messages
};

/// A source's solid, and how the source is got from it.
struct SurfaceUse {
  std::uint32_t solid = 0;
  MirrorMatch match;
};

Error inLink(const std::string& file, const std::string& link, const Error& error) {
  if (error.message == kCancelled) return error;
  return Error{fmt::format("{}: link '{}': {}", file, link, error.message)};
}

class PartCollector {
 public:
  PartCollector(const RobotModel& model, const std::filesystem::path& urdf, const RobotOptions& options,
                const ProgressCallback& progress)
      : model_(model), urdf_(urdf), options_(options), progress_(progress) {
    fitted_.links.resize(model.links.size());
  }

  Result<FittedRobot> run() {
    for (std::uint32_t l = 0; l < model_.links.size(); ++l)
      for (std::uint32_t c = 0; c < model_.links[l].collisions.size(); ++c)
        if (Status s = add(l, c); !s) return s.error();
    if (Status s = readSurfaces(); !s) return s.error();
    matchSurfaces();
    if (Status s = closeSurfaces(); !s) return s.error();
    nameSolids();
    return std::move(fitted_);
  }

 private:
  Status add(std::uint32_t l, std::uint32_t c) {
    const CollisionShape& shape = model_.links[l].collisions[c];
    RobotPart part;
    part.collision = c;
    if (shape.kind == CollisionKind::mesh) {
      part.signs = signsOf(shape.size);
      const Result<std::uint32_t> source = sourceOf(shape, l);
      if (!source) return inLink(model_.file, model_.links[l].name, source.error());
      part.solid = source.value();  // renamed in `nameSolids`
    } else if (shape.kind == CollisionKind::sphere) {
      part.balls = {Ball{shape.origin.translation, shape.size.x, 0}};
      part.covered = part.coversNamed = true;
    } else if (options_.primitives) {
      const auto solid = static_cast<std::uint32_t>(fitted_.solids.size());
      const std::pair key(shape.kind, std::array{shape.size.x, shape.size.y, shape.size.z});
      const auto [known, isNew] = primitives_.try_emplace(key, solid);
      if (isNew) fitted_.solids.push_back(primitiveSolid(shape, options_.objective));
      part.solid = known->second;
    }
    fitted_.links[l].push_back(std::move(part));
    return {};
  }

  Result<std::uint32_t> sourceOf(const CollisionShape& shape, std::uint32_t link) {
    const Result<std::filesystem::path> path = resolveMesh(shape.mesh, urdf_, options_.packages);
    if (!path) return path.error();
    const std::array factors{std::abs(shape.size.x), std::abs(shape.size.y), std::abs(shape.size.z)};
    const auto index = static_cast<std::uint32_t>(sources_.size());
    const auto [known, isNew] = known_.try_emplace({path.value().string(), factors}, index);
    if (isNew) sources_.push_back({path.value(), factors, model_.links[link].name});
    return known->second;
  }

  Status readSurfaces() {
    surfaces_.resize(sources_.size());
    return runJobs(sources_.size(), {"reading meshes", 0, kCollected / 3}, progress_,
                   [&](std::size_t i, const ProgressCallback&) -> Status {
                     const auto& [path, factors, user] = sources_[i];
                     Result<TriangleMesh> surface = readScaledSurface(path, {factors[0], factors[1], factors[2]});
                     if (!surface) return inLink(model_.file, user, surface.error());
                     surfaces_[i] = std::move(surface).value();
                     return {};
                   });
  }

  /// Each surface goes to the first that it is an image of, itself at last.
  void matchSurfaces() {
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) {
      SurfaceUse use{static_cast<std::uint32_t>(firsts_.size()), {}};
      for (std::uint32_t k = 0; k < firsts_.size(); ++k)
        if (const auto match = mirrorMatch(surfaces_[i], surfaces_[firsts_[k]])) {
          use = {k, *match};
          break;
        }
      if (use.solid == firsts_.size()) firsts_.push_back(i);
      uses_.push_back(use);
    }
  }

  Status closeSurfaces() {
    closed_.resize(firsts_.size());
    return runJobs(firsts_.size(), {"closing meshes", kCollected / 3, kCollected}, progress_,
                   [&](std::size_t k, const ProgressCallback& asks) -> Status {
                     Result<RobotSolid> solid = solidOf(std::move(surfaces_[firsts_[k]]), asks);
                     if (!solid) return inLink(model_.file, sources_[firsts_[k]].user, solid.error());
                     closed_[k] = std::move(solid).value();
                     return {};
                   });
  }

  /// Parts of meshes named their source so far.
  void nameSolids() {
    const auto before = static_cast<std::uint32_t>(fitted_.solids.size());
    std::move(closed_.begin(), closed_.end(), std::back_inserter(fitted_.solids));
    for (std::uint32_t l = 0; l < model_.links.size(); ++l)
      for (RobotPart& part : fitted_.links[l]) {
        if (model_.links[l].collisions[part.collision].kind != CollisionKind::mesh) continue;
        const auto& [solid, match] = uses_[*part.solid];
        part.solid = before + solid;
        part.deviation = match.deviation;
        part.signs = {part.signs.x * match.signs.x, part.signs.y * match.signs.y, part.signs.z * match.signs.z};
      }
  }

  const RobotModel& model_;
  const std::filesystem::path& urdf_;
  const RobotOptions& options_;
  const ProgressCallback& progress_;
  FittedRobot fitted_;
  std::map<std::pair<CollisionKind, std::array<double, 3>>, std::uint32_t> primitives_;
  std::map<std::pair<std::string, std::array<double, 3>>, std::uint32_t> known_;
  std::vector<SurfaceSource> sources_;
  std::vector<TriangleMesh> surfaces_;
  std::vector<std::uint32_t> firsts_;  // sources that are no image of another
  std::vector<SurfaceUse> uses_;       // of each source
  std::vector<RobotSolid> closed_;
};

}  // namespace

Result<FittedRobot> collectParts(const RobotModel& model, const std::filesystem::path& urdf,
                                 const RobotOptions& options, const ProgressCallback& progress) {
  return PartCollector(model, urdf, options, progress).run();
}

}  // namespace cairn::builder

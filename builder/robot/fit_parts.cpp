// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/fit_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "robot/collect_parts.h"
#include "robot/parallel_jobs.h"
#include "robot/share_spheres.h"
#include "robot/solid_cover.h"

namespace cairn::builder {
namespace {

/// Fractions of the whole work: when budgets are shared out, when spheres are placed.
constexpr double kShared = 0.4, kPlaced = 0.95;

/// A solid with so many spheres; 0 where the largest error decides.
using CoverKey = std::pair<std::uint32_t, std::uint32_t>;

class PartFitter {
 public:
  PartFitter(const RobotModel& model, const RobotOptions& options, const ProgressCallback& progress,
             FittedRobot& fitted)
      : model_(model), options_(options), progress_(progress), fitted_(fitted) {
    forParts([&](std::uint32_t l, const RobotPart& part) {
      users_.try_emplace(*part.solid, l);
      double& placing = placing_[*part.solid];
      const CollisionShape& shape = model.links[l].collisions[part.collision];
      placing = std::max(placing, placingError(part, fitted.solids[*part.solid], shape));
    });
  }

  Status run() {
    Status shared = options_.budget.total ? shareAmongAll() : options_.budget.perLink ? shareInLinks() : Status();
    if (!shared) return shared;
    if (Status s = makeCovers(); !s) return s;
    forParts([&](std::uint32_t l, RobotPart& part) {
      placeCover(covers_.at(keyOf(part)), options_.objective, model_.links[l].collisions[part.collision], part);
    });
    return {};
  }

 private:
  void forParts(const std::function<void(std::uint32_t link, RobotPart&)>& visit) {
    for (std::uint32_t l = 0; l < fitted_.links.size(); ++l)
      for (RobotPart& part : fitted_.links[l])
        if (part.solid) visit(l, part);
  }
  CoverKey keyOf(const RobotPart& part) const {
    const auto count = counts_.find(&part);
    return {*part.solid, count == counts_.end() ? 0 : count->second};
  }

  Status shareAmongAll() {
    std::map<std::uint32_t, std::uint32_t> copies;
    forParts([&](std::uint32_t, RobotPart& part) { ++copies[*part.solid]; });
    std::vector<SphereClaim> claims;
    std::uint32_t least = 0;
    for (const auto& [solid, count] : copies) {
      claims.push_back({solid, count});
      least += count;
    }
    if (*options_.budget.total < least)
      return Error{fmt::format("{}: {} spheres are too few for {} meshes; give each one", model_.file,
                               *options_.budget.total, least)};
    const auto given = shareSpheres(claims, *options_.budget.total, [&](const auto& asked) { return errors(asked); });
    if (!given) return given.error();
    forParts([&](std::uint32_t, RobotPart& part) {
      const auto claim =
          std::find_if(claims.begin(), claims.end(), [&](const auto& c) { return c.solid == *part.solid; });
      counts_[&part] = given.value()[static_cast<std::size_t>(claim - claims.begin())];
    });
    return {};
  }

  Status shareInLinks() {
    for (std::uint32_t l = 0; l < fitted_.links.size(); ++l) {
      std::vector<SphereClaim> claims;
      std::vector<const RobotPart*> parts;
      for (const RobotPart& part : fitted_.links[l]) {
        if (!part.solid) continue;
        claims.push_back({*part.solid, 1});
        parts.push_back(&part);
      }
      const auto own = options_.budget.ofLink.find(model_.links[l].name);
      const std::uint32_t total = own == options_.budget.ofLink.end() ? *options_.budget.perLink : own->second;
      if (total < claims.size())
        return Error{fmt::format("{}: link '{}' has {} meshes for {} spheres; give each one (--link-spheres {}={})",
                                 model_.file, model_.links[l].name, claims.size(), total, model_.links[l].name,
                                 claims.size())};
      const auto given = shareSpheres(claims, total, [&](const auto& asked) {
        return claims.size() > 1 ? errors(asked) : Result<std::vector<double>>(std::vector<double>(asked.size()));
      });
      if (!given) return given.error();
      for (std::size_t i = 0; i < parts.size(); ++i) counts_[parts[i]] = given.value()[i];
    }
    return {};
  }

  /// Estimates, kept: links that share a solid ask for the same ones.
  Result<std::vector<double>> errors(const std::vector<SphereCount>& asked) {
    std::set<CoverKey> missing;
    for (const auto& [solid, spheres] : asked)
      if (!estimates_.contains({solid, spheres})) missing.insert({solid, spheres});
    const std::vector<CoverKey> keys(missing.begin(), missing.end());
    std::vector<double> found(keys.size());
    // Nobody knows how many rounds there are: each goes a fifth of the way that is left.
    const double next = shared_ + 0.2 * (kShared - shared_);
    const Status done = runJobs(keys.size(), {"sharing spheres out", shared_, next}, progress_,
                                [&](std::size_t i, const ProgressCallback& asks) -> Status {
                                  const auto cover = coverOf(keys[i], true, asks);
                                  if (!cover) return cover.error();
                                  found[i] = errorOf(cover.value(), options_.objective);
                                  return {};
                                });
    if (!done) return done.error();
    shared_ = next;
    for (std::size_t i = 0; i < keys.size(); ++i) estimates_[keys[i]] = found[i];
    std::vector<double> result;
    for (const auto& [solid, spheres] : asked) result.push_back(estimates_.at({solid, spheres}));
    return result;
  }

  Result<SolidCover> coverOf(const CoverKey& key, bool quick, const ProgressCallback& asks) const {
    CoverWish wish{.objective = options_.objective, .seed = options_.seed, .quick = quick};
    if (key.second != 0)
      wish.spheres = key.second;
    else
      wish.maxError = *options_.budget.maxError - placing_.at(key.first);
    Result<SolidCover> cover = coverSolid(fitted_.solids[key.first], wish, asks);
    if (cover || cover.error().message == kCancelled) return cover;
    return Error{
        fmt::format("{}: link '{}': {}", model_.file, model_.links[users_.at(key.first)].name, cover.error().message)};
  }

  /// A skin that is farther off than the largest error is refused before any work.
  Status checkReachable(const CoverKey& key) const {
    const RobotSolid& solid = fitted_.solids[key.first];
    if (key.second != 0 || *options_.budget.maxError > solid.offOriginal + placing_.at(key.first)) return {};
    return Error{
        fmt::format("{}: link '{}': the closed skin of '{}' alone is up to {:.3g} m off; ask for a larger "
                    "--max-error",
                    model_.file, model_.links[users_.at(key.first)].name, solid.name, solid.offOriginal)};
  }

  Status makeCovers() {
    std::set<CoverKey> wanted;
    forParts([&](std::uint32_t, RobotPart& part) { wanted.insert(keyOf(part)); });
    const std::vector<CoverKey> keys(wanted.begin(), wanted.end());
    for (const CoverKey& key : keys)
      if (Status s = checkReachable(key); !s) return s;
    std::vector<SolidCover> made(keys.size());
    const WorkShare share{"placing spheres", options_.budget.maxError ? kCollected : kShared, kPlaced};
    const Status done =
        runJobs(keys.size(), share, progress_, [&](std::size_t i, const ProgressCallback& asks) -> Status {
          Result<SolidCover> cover = coverOf(keys[i], false, asks);
          if (!cover) return cover.error();
          made[i] = std::move(cover).value();
          return {};
        });
    if (!done) return done;
    for (std::size_t i = 0; i < keys.size(); ++i) covers_[keys[i]] = std::move(made[i]);
    return {};
  }

  const RobotModel& model_;
  const RobotOptions& options_;
  const ProgressCallback& progress_;
  FittedRobot& fitted_;
  std::map<std::uint32_t, std::uint32_t> users_;      // of each solid the first link, for messages
  std::map<std::uint32_t, double> placing_;           // of each solid what placing adds to its error, metres
  std::map<const RobotPart*, std::uint32_t> counts_;  // spheres of each part
  std::map<CoverKey, double> estimates_;
  double shared_ = kCollected;  // how far the whole work is
  std::map<CoverKey, SolidCover> covers_;
};

}  // namespace

Status checkBudget(const RobotModel& model, const RobotBudget& budget) {
  if (int(budget.perLink.has_value()) + int(budget.total.has_value()) + int(budget.maxError.has_value()) != 1)
    return Error{"spheres are counted for each link, in total, or follow from a largest error; give one of the three"};
  const auto inRange = [](std::uint32_t n) { return n >= 1 && n <= kMaxCoverSpheres; };
  if (budget.perLink && !inRange(*budget.perLink))
    return Error{
        fmt::format("{} spheres cannot be placed in a link; ask for 1 to {}", *budget.perLink, kMaxCoverSpheres)};
  if (budget.maxError && !(std::isfinite(*budget.maxError) && *budget.maxError > 0))
    return Error{fmt::format("{} is no error spheres can keep; give a length above 0", *budget.maxError)};
  for (const auto& [name, count] : budget.ofLink) {
    const auto isIt = [&](const RobotLink& link) { return link.name == name; };
    if (std::none_of(model.links.begin(), model.links.end(), isIt))
      return Error{
          fmt::format("{}: there is no link '{}' to have {} spheres; correct its name", model.file, name, count)};
    if (!inRange(count))
      return Error{
          fmt::format("{} spheres cannot be placed in link '{}'; ask for 1 to {}", count, name, kMaxCoverSpheres)};
  }
  return {};
}

Status fitParts(const RobotModel& model, const RobotOptions& options, const ProgressCallback& progress,
                FittedRobot& fitted) {
  return PartFitter(model, options, progress, fitted).run();
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cassert>

#include "cairn/builder/build.h"
#include "regions/method_traits.h"
#include "spheres/better_of_both.h"
#include "spheres/burst.h"
#include "spheres/expand.h"
#include "spheres/grid.h"
#include "spheres/merge.h"
#include "spheres/spawn.h"

namespace cairn::builder {

namespace {

/// A method that takes the balls which hold the region together, as a row of the table.
template <SphereSet (*kReduce)(const CoverProblem&, std::span<const Ball>)>
SphereSet fromCovering(Optimiser, const CoverProblem& problem, const Candidates& candidates) {
  return kReduce(problem, candidates.covering);
}

SphereSet coverMostFirst(Optimiser, const CoverProblem& problem, const Candidates& candidates) {
  return expand(problem, candidates.all, ExpandRank::maxCover);
}

constexpr std::array kMethods{
    MethodTraits{Method::combined, "combined", Optimiser::cairn, Refit::tightest, Division::spheres, GrownIn::body,
                 betterOfBoth},
    MethodTraits{Method::merge, "merge", Optimiser::cairn, Refit::tightest, Division::spheres, GrownIn::body,
                 fromCovering<merge>},
    MethodTraits{Method::expand, "expand", Optimiser::cairn, Refit::tightest, Division::spheres, GrownIn::body,
                 expandFor},
    MethodTraits{Method::adaptive, "adaptive", Optimiser::cairn, Refit::tightest, Division::levels, GrownIn::body},
    MethodTraits{Method::expandCover, "expand-cover", Optimiser::none, Refit::tightest, Division::spheres,
                 GrownIn::body, coverMostFirst},
    MethodTraits{Method::burst, "burst", Optimiser::none, Refit::tightest, Division::spheres, GrownIn::body,
                 fromCovering<burst>},
    MethodTraits{Method::spawn, "spawn", Optimiser::none, Refit::tightest, Division::spheres, GrownIn::body, spawn},
    MethodTraits{Method::hubbard, "hubbard", Optimiser::none, Refit::none, Division::groups, GrownIn::mesh},
    // These three have the same regions and differ in the ball of each.
    MethodTraits{Method::grid, "grid", Optimiser::none, Refit::tightest, Division::spheres, GrownIn::mesh, gridSpheres},
    MethodTraits{Method::gridVolume, "grid-volume", Optimiser::none, Refit::smallest, Division::spheres, GrownIn::mesh,
                 gridSpheres},
    MethodTraits{Method::hybrid, "hybrid", Optimiser::none, Refit::leastError, Division::spheres, GrownIn::mesh,
                 gridSpheres},
    MethodTraits{Method::octree, "octree", Optimiser::none, Refit::none, Division::cubes, GrownIn::mesh},
    MethodTraits{Method::solidOctree, "solid-octree", Optimiser::none, Refit::none, Division::cubes, GrownIn::mesh},
};
static_assert(std::ranges::all_of(kMethods, [](const MethodTraits& traits) {
  return (traits.division == Division::spheres) != std::holds_alternative<std::monostate>(traits.fit);
}));

/// Rows are in the order of the enumeration.
constexpr std::array<const char*, 3> kOptimisers{"none", "thesis", "cairn"};
constexpr std::array<const char*, 2> kDivisions{"stand-off", "planes"};

}  // namespace

std::span<const MethodTraits> allMethods() {
  return kMethods;
}

const MethodTraits& traitsOf(Method method) {
  const auto* const found =
      std::find_if(kMethods.begin(), kMethods.end(), [method](const MethodTraits& t) { return t.method == method; });
  assert(found != kMethods.end());
  return *found;
}

Result<Method> parseMethod(const std::string& name) {
  std::string known;
  for (const MethodTraits& traits : kMethods) {
    if (name == traits.name) return traits.method;
    known += (known.empty() ? "" : ", ") + std::string(traits.name);
  }
  return Error{"there is no method '" + name + "'; choose one of " + known};
}

const char* methodName(Method method) {
  return traitsOf(method).name;
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const MethodTraits& traits : kMethods) names.emplace_back(traits.name);
  return names;
}

Result<Optimiser> parseOptimiser(const std::string& name) {
  const auto* const found = std::find(kOptimisers.begin(), kOptimisers.end(), name);
  if (found == kOptimisers.end())
    return Error{"there is no optimisation '" + name + "'; choose one of none, thesis, cairn"};
  return static_cast<Optimiser>(found - kOptimisers.begin());
}

const char* optimiserName(Optimiser optimiser) {
  return kOptimisers[static_cast<std::size_t>(optimiser)];
}

std::vector<std::string> optimiserNames() {
  return {kOptimisers.begin(), kOptimisers.end()};
}

Result<SurfaceDivision> parseDivision(const std::string& name) {
  const auto* const found = std::find(kDivisions.begin(), kDivisions.end(), name);
  if (found == kDivisions.end()) return Error{"there is no division '" + name + "'; choose one of stand-off, planes"};
  return static_cast<SurfaceDivision>(found - kDivisions.begin());
}

const char* divisionName(SurfaceDivision division) {
  return kDivisions[static_cast<std::size_t>(division)];
}

std::vector<std::string> divisionNames() {
  return {kDivisions.begin(), kDivisions.end()};
}

bool fitsRegions(Method method) {
  return traitsOf(method).division == Division::spheres;
}

bool optimisedByCairn(Method method) {
  return traitsOf(method).optimiser == Optimiser::cairn;
}

bool dividesByEight(Method method) {
  return traitsOf(method).division == Division::cubes;
}

}  // namespace cairn::builder

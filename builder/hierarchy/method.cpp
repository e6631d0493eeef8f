// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cassert>

#include "cairn/builder/build.h"
#include "hierarchy/method_traits.h"

namespace cairn::builder {

namespace {

constexpr bool kImproved = true, kAsInTheThesis = false;
constexpr bool kCubes = true, kBalls = false;

constexpr std::array kMethods{
    MethodTraits{Method::combined, "combined", kImproved, Refit::tightest, kBalls},
    MethodTraits{Method::merge, "merge", kImproved, Refit::tightest, kBalls},
    MethodTraits{Method::expand, "expand", kImproved, Refit::tightest, kBalls},
    MethodTraits{Method::adaptive, "adaptive", kImproved, Refit::tightest, kBalls},
    MethodTraits{Method::expandCover, "expand-cover", kAsInTheThesis, Refit::tightest, kBalls},
    MethodTraits{Method::burst, "burst", kAsInTheThesis, Refit::tightest, kBalls},
    MethodTraits{Method::spawn, "spawn", kAsInTheThesis, Refit::tightest, kBalls},
    MethodTraits{Method::hubbard, "hubbard", kAsInTheThesis, Refit::none, kBalls},
    MethodTraits{Method::grid, "grid", kAsInTheThesis, Refit::smallest, kBalls},
    MethodTraits{Method::octree, "octree", kAsInTheThesis, Refit::none, kCubes},
    MethodTraits{Method::solidOctree, "solid-octree", kAsInTheThesis, Refit::none, kCubes},
};

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

bool dividesByEight(Method method) {
  return traitsOf(method).cubes;
}

}  // namespace cairn::builder

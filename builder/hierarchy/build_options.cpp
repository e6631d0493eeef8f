// SPDX-License-Identifier: GPL-3.0-or-later
#include "build_options.h"

#include <cmath>
#include <string>

namespace cairn::builder {

namespace {

/// A level of 4096 spheres takes a gigabyte, mostly for its cost matrices with eight times as many points.
constexpr double kMaxAdaptiveLeaves = 4096;

Status checkRange(const char* option, std::uint64_t value, std::uint64_t least, std::uint64_t most) {
  if (value >= least && value <= most) return {};
  return Error{"the option " + std::string(option) + " is " + std::to_string(value) + "; choose " +
               std::to_string(least) + " to " + std::to_string(most)};
}

Status checkDivision(const BuildOptions& options) {
  if (options.division == SurfaceDivision::standOff) return {};
  const std::string name = "the option division is " + std::string(divisionName(options.division));
  if (!fitsRegions(options.method))
    return Error{name + ", but the method " + std::string(methodName(options.method)) +
                 " does not fit spheres region by region; leave it out or choose another method"};
  if (options.optimiser ? *options.optimiser == Optimiser::cairn : optimisedByCairn(options.method))
    return Error{name + ", but the optimiser cairn moves the seams itself; choose the optimiser none or thesis"};
  return {};
}

}  // namespace

Status checkOptions(const BuildOptions& options) {
  if (Status s = checkRange("branching", options.branching, 2, kFamilyWidth); !s) return s;
  if (Status s = checkRange("depth", options.depth, 1, 8); !s) return s;
  if (Status s = checkRange("samples", options.samples, 100, 1'000'000); !s) return s;
  if (Status s = checkRange("threads", options.threads, 0, 1024); !s) return s;
  if (dividesByEight(options.method) && options.branching != kFamilyWidth)
    return Error{"the method " + std::string(methodName(options.method)) +
                 " divides by eight, but the option branching is " + std::to_string(options.branching) +
                 "; choose 8 or another method"};
  if (!fitsRegions(options.method) && (options.optimiser || options.balance))
    return Error{"the method " + std::string(methodName(options.method)) +
                 " does not fit spheres region by region, as the option " +
                 (options.optimiser ? "optimiser" : "balance") + " needs; leave it out or choose another method"};
  if (Status s = checkDivision(options); !s) return s;
  if (options.method == Method::adaptive && std::pow(options.branching, options.depth) > kMaxAdaptiveLeaves)
    return Error{
        "the method adaptive fits all spheres of a level at once, but the options branching and depth ask for " +
        std::to_string(options.branching) + "^" + std::to_string(options.depth) +
        " of them; choose a smaller depth or another method"};
  return {};
}

}  // namespace cairn::builder

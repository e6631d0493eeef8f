// SPDX-License-Identifier: GPL-3.0-or-later
#include "build_options.h"

#include <string>

namespace cairn::builder {

namespace {

Status checkRange(const char* option, std::uint64_t value, std::uint64_t least, std::uint64_t most) {
  if (value >= least && value <= most) return {};
  return Error{"the option " + std::string(option) + " is " + std::to_string(value) + "; choose " +
               std::to_string(least) + " to " + std::to_string(most)};
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
  return {};
}

}  // namespace cairn::builder

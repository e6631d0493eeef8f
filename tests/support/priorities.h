// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <string>

#include "cairn/core/perceptual.h"
#include "cairn/core/round_robin.h"
#include "cairn/core/two_classes.h"
#include "cairn/core/worst_error_first.h"

namespace cairn::test {

/// Every priority there is, by the name of its class.
inline const std::string kPriorities[] = {"RoundRobin", "TwoClasses", "WorstErrorFirst", "Perceptual"};

/// Precondition: one of `kPriorities`.
inline std::unique_ptr<Priority> makePriority(const std::string& name) {
  if (name == "TwoClasses") return std::make_unique<TwoClasses>();
  if (name == "WorstErrorFirst") return std::make_unique<WorstErrorFirst>();
  if (name == "Perceptual") return std::make_unique<Perceptual>();
  return std::make_unique<RoundRobin>();
}

}  // namespace cairn::test

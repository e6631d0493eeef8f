// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::builder {

/// A solid that wants spheres, once for each of its copies.
struct SphereClaim {
  std::uint32_t solid = 0, copies = 1;
};

/// A solid with so many spheres.
struct SphereCount {
  std::uint32_t solid = 0, spheres = 0;
};

/// The error of each, mesh unit.
using ErrorsOf = std::function<Result<std::vector<double>>(const std::vector<SphereCount>&)>;

/// Shares spheres among claims: each gets one, then the next ones always go where the error falls most for a sphere,
/// averaged up to the count at which that is most. Errors are asked for at few counts, which grow by a half, and never
/// rise on the way. What is left in the end and is too few for a claim's copies goes to others, or to nobody.
///
/// Returns the spheres of one copy of each claim. Precondition: `total` is at least the sum of copies.
Result<std::vector<std::uint32_t>> shareSpheres(const std::vector<SphereClaim>& claims, std::uint32_t total,
                                                const ErrorsOf& errorsOf);

}  // namespace cairn::builder

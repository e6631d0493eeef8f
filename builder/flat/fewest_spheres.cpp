// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/fewest_spheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace cairn::builder {
namespace {

/// The rough search ends when the numbers it is between differ by this part.
constexpr std::uint32_t kRoughParts = 12;

class FewestSearch {
 public:
  FewestSearch(double maxError, Objective objective, const MakeCover& make)
      : maxError_(maxError), objective_(objective), make_(make) {}

  /// Nothing when even the most do not keep the error, or when cancelled (see `failure`).
  std::optional<Cover> run() {
    rough();
    // All effort at what little effort found; upwards should even that fail.
    std::uint32_t count = enough_;
    while (!failure_ && !keeps(count, Effort::full)) {
      failed_ = count;
      if (count == kMaxCoverSpheres) return std::nullopt;
      count = std::min(kMaxCoverSpheres, count + std::max(1U, count / kRoughParts));
    }
    enough_ = count;
    fine();
    return failure_ ? std::nullopt : std::move(best_);
  }

  const std::optional<Error>& failure() const { return failure_; }

 private:
  bool keeps(std::uint32_t count, Effort effort) {
    Result<Cover> cover = make_(count, effort);
    if (!cover) {
      failure_ = cover.error();
      return false;
    }
    if (cover.value().error(objective_) > maxError_) return false;
    if (effort == Effort::full) best_ = std::move(cover).value();
    return true;
  }

  /// Brackets the number: `tooFew_` do not keep the error with little effort, `enough_` do, or are the most there may
  /// be.
  void rough() {
    while (!failure_ && enough_ < kMaxCoverSpheres && !keeps(enough_, Effort::quick)) {
      tooFew_ = enough_;
      enough_ = std::min(2 * enough_, kMaxCoverSpheres);
    }
    while (!failure_ && enough_ - tooFew_ > std::max(1U, enough_ / kRoughParts)) {
      const std::uint32_t middle = (tooFew_ + enough_) / 2;
      (keeps(middle, Effort::quick) ? enough_ : tooFew_) = middle;
    }
  }

  /// Downwards from `enough_` with all effort, in growing strides, then halving between what fails and what does not.
  void fine() {
    for (std::uint32_t stride = std::max(1U, enough_ / (2 * kRoughParts)); !failure_ && enough_ - failed_ > 1;
         stride *= 2) {
      const std::uint32_t fewer = enough_ - failed_ > stride ? enough_ - stride : failed_ + 1;
      if (!keeps(fewer, Effort::full)) {
        failed_ = fewer;
        break;
      }
      enough_ = fewer;
    }
    while (!failure_ && enough_ - failed_ > 1) {
      const std::uint32_t middle = (failed_ + enough_) / 2;
      (keeps(middle, Effort::full) ? enough_ : failed_) = middle;
    }
  }

  double maxError_;
  Objective objective_;
  const MakeCover& make_;
  std::uint32_t tooFew_ = 0, enough_ = 1;  // with little effort, then `enough_` with all
  std::uint32_t failed_ = 0;               // the most that failed with all effort
  std::optional<Cover> best_;
  std::optional<Error> failure_;
};

}  // namespace

Result<Cover> fewestSpheres(double maxError, Objective objective, const std::string& meshName, const MakeCover& make) {
  FewestSearch search(maxError, objective, make);
  std::optional<Cover> cover = search.run();
  if (cover) return *std::move(cover);
  if (search.failure()) return *search.failure();
  return Error{fmt::format("{}: {} spheres do not keep an error of {} (mesh units); ask for a larger one", meshName,
                           kMaxCoverSpheres, maxError)};
}

}  // namespace cairn::builder

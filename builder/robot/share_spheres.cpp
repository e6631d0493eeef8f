// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/share_spheres.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cairn/builder/cover.h"

namespace cairn::builder {
namespace {

struct CurvePoint {
  std::uint32_t spheres = 0;
  double error = 0;
};

/// A claim with what it has, and its error as far as it is known.
struct Account {
  SphereClaim claim;
  std::uint32_t given = 1;
  std::vector<CurvePoint> curve;  // by growing number
};

/// A next gift: so many spheres more for each copy.
struct Gift {
  std::size_t account = 0;
  std::uint32_t more = 0;
  double fall = -1;  // of the error, per sphere of a copy
};

/// Errors up to so many spheres are always known: solids with several arms gain nothing before each arm has a sphere.
constexpr std::uint32_t kFirstLook = 8;

std::uint32_t nextCount(std::uint32_t spheres) {
  return spheres + std::max(1U, spheres / 2);
}

class SphereShare {
 public:
  SphereShare(const std::vector<SphereClaim>& claims, std::uint32_t total, const ErrorsOf& errorsOf)
      : left_(total), errorsOf_(errorsOf) {
    for (const SphereClaim& claim : claims) {
      accounts_.push_back({claim, 1, {}});
      left_ -= claim.copies;
    }
  }

  Result<std::vector<std::uint32_t>> run() {
    while (canGive()) {
      if (Status s = lookAhead(); !s) return s.error();
      const Gift gift = best();
      Account& account = accounts_[gift.account];
      account.given += gift.more;
      left_ -= gift.more * account.claim.copies;
    }
    std::vector<std::uint32_t> given;
    for (const Account& account : accounts_) given.push_back(account.given);
    return given;
  }

 private:
  std::uint32_t affordable(const Account& account) const {
    return std::min(left_ / account.claim.copies, kMaxCoverSpheres - account.given);
  }
  bool canGive() const {
    return std::any_of(accounts_.begin(), accounts_.end(), [&](const Account& a) { return affordable(a) > 0; });
  }

  /// Curves reach `kFirstLook` and twice what is given, so that a step without gain does not hide the gain behind it.
  Status lookAhead() {
    for (;;) {
      std::vector<SphereCount> asked;
      std::vector<Account*> askers;
      for (Account& account : accounts_) {
        const std::uint32_t known = account.curve.empty() ? 0 : account.curve.back().spheres;
        const std::uint32_t most = account.given + affordable(account);
        if (affordable(account) == 0 || known >= std::min(std::max(kFirstLook, 2 * account.given), most)) continue;
        asked.push_back({account.claim.solid, std::min(known == 0 ? 1 : nextCount(known), most)});
        askers.push_back(&account);
      }
      if (asked.empty()) return {};
      const Result<std::vector<double>> errors = errorsOf_(asked);
      if (!errors) return errors.error();
      for (std::size_t i = 0; i < asked.size(); ++i) add(*askers[i], {asked[i].spheres, errors.value()[i]});
    }
  }

  static void add(Account& account, CurvePoint point) {
    if (!account.curve.empty()) point.error = std::min(point.error, account.curve.back().error);
    account.curve.push_back(point);
  }

  /// Between known numbers the error is taken as falling evenly.
  static double errorAt(const Account& account, std::uint32_t spheres) {
    const auto after = std::find_if(account.curve.begin(), account.curve.end(),
                                    [&](const CurvePoint& p) { return p.spheres >= spheres; });
    if (after == account.curve.end()) return account.curve.back().error;
    if (after->spheres == spheres || after == account.curve.begin()) return after->error;
    const CurvePoint& before = *(after - 1);
    const double part = double(spheres - before.spheres) / double(after->spheres - before.spheres);
    return before.error + part * (after->error - before.error);
  }

  Gift best() const {
    Gift best;
    for (std::size_t i = 0; i < accounts_.size(); ++i) {
      const Account& account = accounts_[i];
      const std::uint32_t most = affordable(account);
      if (most == 0) continue;
      const double now = errorAt(account, account.given);
      for (const CurvePoint& point : account.curve) {
        if (point.spheres <= account.given) continue;
        const double fall = (now - point.error) / double(point.spheres - account.given);
        if (fall > best.fall) best = {i, std::min(most, point.spheres - account.given), fall};
      }
    }
    return best;
  }

  std::vector<Account> accounts_;
  std::uint32_t left_;
  const ErrorsOf& errorsOf_;
};

}  // namespace

Result<std::vector<std::uint32_t>> shareSpheres(const std::vector<SphereClaim>& claims, std::uint32_t total,
                                                const ErrorsOf& errorsOf) {
  return SphereShare(claims, total, errorsOf).run();
}

}  // namespace cairn::builder

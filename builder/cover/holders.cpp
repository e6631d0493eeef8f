// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compiled once per instruction set by Highway; the best one of the machine is chosen at run time. The code only
// compares and selects, so every target gives the same result.
#include "cover/holders.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cover/holders.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::builder::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Costs = hn::CappedTag<double, 8>;
using Wide = hn::RebindToUnsigned<Costs>;
using Names = hn::Rebind<std::uint32_t, Costs>;

HWY_INLINE unsigned bitsOf(hn::Mask<Costs> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Costs(), mask, bits);
  return bits[0];
}

/// Applies `Holder::update` to several points; `open` takes those that it refuses. Returns the number of processed
/// points.
std::size_t updateMany(std::uint32_t i, const double* HWY_RESTRICT costs, std::size_t size,
                       std::uint32_t* HWY_RESTRICT balls, std::uint32_t* HWY_RESTRICT seconds,
                       double* HWY_RESTRICT firstCosts, double* HWY_RESTRICT secondCosts,
                       std::vector<std::uint32_t>& open) {
  const Costs d;
  const Wide wide;
  const Names names;
  const auto self = hn::Set(wide, std::uint64_t{i});
  std::size_t k = 0;
  for (; k + hn::Lanes(d) <= size; k += hn::Lanes(d)) {
    const auto changed = hn::LoadU(d, costs + k);
    const auto cost = hn::LoadU(d, firstCosts + k), secondCost = hn::LoadU(d, secondCosts + k);
    const auto ball = hn::PromoteTo(wide, hn::LoadU(names, balls + k));
    const auto second = hn::PromoteTo(wide, hn::LoadU(names, seconds + k));
    const auto isFirst = hn::RebindMask(d, hn::Eq(ball, self)), isSecond = hn::RebindMask(d, hn::Eq(second, self));
    const auto refused = hn::And(hn::Or(isFirst, isSecond), hn::Ge(changed, secondCost));
    for (unsigned bits = bitsOf(refused), at = 0; bits != 0; bits >>= 1, ++at)
      if (bits & 1) open.push_back(static_cast<std::uint32_t>(k + at));
    const auto cheaper = hn::Lt(changed, cost);
    const auto overtakes = hn::AndNot(isFirst, cheaper), next = hn::AndNot(isFirst, hn::Lt(changed, secondCost));
    const auto overtakesWide = hn::RebindMask(wide, overtakes), nextWide = hn::RebindMask(wide, next);
    hn::StoreU(hn::IfThenElse(hn::Or(cheaper, isFirst), changed, cost), d, firstCosts + k);
    hn::StoreU(hn::IfThenElse(overtakes, cost, hn::IfThenElse(next, changed, secondCost)), d, secondCosts + k);
    hn::StoreU(hn::TruncateTo(names, hn::IfThenElse(overtakesWide, self, ball)), names, balls + k);
    hn::StoreU(hn::TruncateTo(names, hn::IfThenElse(overtakesWide, ball, hn::IfThenElse(nextWide, self, second))),
               names, seconds + k);
  }
  return k;
}

/// Collects the duties among several points and counts them. `looked` receives the number of processed points.
std::size_t dutiesOfMany(std::uint32_t i, const double* HWY_RESTRICT costs, std::size_t size, double goal,
                         const std::uint32_t* HWY_RESTRICT balls, const double* HWY_RESTRICT firstCosts,
                         const double* HWY_RESTRICT secondCosts, std::uint32_t* HWY_RESTRICT duties,
                         std::size_t& looked) {
  const Costs d;
  const Wide wide;
  const auto self = hn::Set(wide, std::uint64_t{i});
  const auto most = hn::Set(d, goal);
  std::size_t k = 0, count = 0;
  for (; k + hn::Lanes(d) <= size; k += hn::Lanes(d)) {
    const auto ball = hn::PromoteTo(wide, hn::LoadU(Names(), balls + k));
    const auto others = hn::IfThenElse(hn::RebindMask(d, hn::Eq(ball, self)), hn::LoadU(d, secondCosts + k),
                                       hn::LoadU(d, firstCosts + k));
    const auto duty = hn::And(hn::Gt(others, most), hn::Ge(others, hn::LoadU(d, costs + k)));
    for (unsigned bits = bitsOf(duty), at = 0; bits != 0; bits >>= 1, ++at) {
      duties[count] = static_cast<std::uint32_t>(k + at);
      count += bits & 1;
    }
  }
  looked = k;
  return count;
}

}  // namespace cairn::builder::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::builder {

HWY_EXPORT(updateMany);
HWY_EXPORT(dutiesOfMany);

void Holders::update(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs,
                     std::vector<std::uint32_t>& open) {
  assert(which.size() == costs.size());
  open.clear();
  std::size_t k = 0;
  if (which.size() == size())
    k = HWY_DYNAMIC_DISPATCH(updateMany)(i, costs.data(), costs.size(), ball_.data(), second_.data(), cost_.data(),
                                         secondCost_.data(), open);
  for (; k < which.size(); ++k) {
    Holder holder = at(which[k]);
    if (holder.update(i, costs[k]))
      set(which[k], holder);
    else
      open.push_back(static_cast<std::uint32_t>(k));
  }
}

void Holders::duties(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs, double goal,
                     std::vector<std::uint32_t>& duties) const {
  assert(which.size() == costs.size());
  duties.resize(which.size());
  std::size_t k = 0, count = 0;
  if (which.size() == size())
    count = HWY_DYNAMIC_DISPATCH(dutiesOfMany)(i, costs.data(), costs.size(), goal, ball_.data(), cost_.data(),
                                               secondCost_.data(), duties.data(), k);
  for (; k < which.size(); ++k) {
    const std::uint32_t point = which[k];
    const double others = ball_[point] == i ? secondCost_[point] : cost_[point];
    duties[count] = static_cast<std::uint32_t>(k);
    count += static_cast<std::size_t>(others > goal) & static_cast<std::size_t>(others >= costs[k]);
  }
  duties.resize(count);
}

}  // namespace cairn::builder
#endif

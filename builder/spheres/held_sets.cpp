// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compiled once per instruction set by Highway; the best one of the machine is chosen at run time. The code only
// compares and counts bits, so every target gives the same result.
#include "spheres/held_sets.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spheres/held_sets.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::builder::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::CappedTag<std::uint64_t, 8>;
using Costs = hn::CappedTag<double, 8>;

/// The bits of 64 costs that are at most `standOff`.
std::uint64_t bitsWithin(const double* HWY_RESTRICT costs, double standOff) {
  const Costs d;
  const auto limit = hn::Set(d, standOff);
  std::uint64_t word = 0;
  for (std::size_t k = 0; k < HeldSets::kBitsPerWord; k += hn::Lanes(d)) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Le(hn::LoadU(d, costs + k), limit), bits);
    word |= std::uint64_t{bits[0]} << k;
  }
  return word;
}

/// By column: its number of bits.
void countColumns(const std::uint64_t* HWY_RESTRICT bits, std::size_t words, std::size_t stride,
                  std::uint64_t* HWY_RESTRICT counts) {
  const Words d;
  for (std::size_t i = 0; i < stride; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (std::size_t w = 0; w < words; ++w)
      sum = hn::Add(sum, hn::PopulationCount(hn::LoadU(d, bits + w * stride + i)));
    hn::StoreU(sum, d, counts + i);
  }
}

/// Number of columns without a bit that column `k` lacks.
std::size_t subsetColumns(const std::uint64_t* HWY_RESTRICT bits, std::size_t words, std::size_t stride,
                          std::size_t k) {
  const Words d;
  std::size_t count = 0;
  for (std::size_t i = 0; i < stride; i += hn::Lanes(d)) {
    auto beyond = hn::Zero(d);
    for (std::size_t w = 0; w < words; ++w)
      beyond = hn::Or(beyond, hn::AndNot(hn::Set(d, bits[w * stride + k]), hn::LoadU(d, bits + w * stride + i)));
    count += hn::CountTrue(d, hn::Eq(beyond, hn::Zero(d)));
  }
  return count;
}

/// Removes the bits of column `k` from all columns.
void removeColumn(std::uint64_t* HWY_RESTRICT bits, std::size_t words, std::size_t stride, std::size_t k) {
  const Words d;
  for (std::size_t w = 0; w < words; ++w) {
    const auto taken = hn::Set(d, bits[w * stride + k]);
    for (std::size_t i = 0; i < stride; i += hn::Lanes(d))
      hn::StoreU(hn::AndNot(taken, hn::LoadU(d, bits + w * stride + i)), d, bits + w * stride + i);
  }
}

}  // namespace cairn::builder::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::builder {

HWY_EXPORT(bitsWithin);
HWY_EXPORT(countColumns);
HWY_EXPORT(subsetColumns);
HWY_EXPORT(removeColumn);

namespace {

/// Number of columns in the widest vector.
constexpr std::size_t kWidest = 8;

}  // namespace

HeldSets::HeldSets(std::span<const double> costs, std::size_t padded, double standOff) : words_(padded / kBitsPerWord) {
  assert(padded % kBitsPerWord == 0 && padded > 0 && costs.size() % padded == 0);
  names_.resize(costs.size() / padded);
  std::iota(names_.begin(), names_.end(), std::size_t{0});
  stride_ = (names_.size() + kWidest - 1) / kWidest * kWidest;
  bits_.assign(words_ * stride_, 0);
  for (std::size_t i = 0; i < names_.size(); ++i)
    for (std::size_t w = 0; w < words_; ++w)
      bits_[w * stride_ + i] = HWY_DYNAMIC_DISPATCH(bitsWithin)(costs.data() + i * padded + w * kBitsPerWord, standOff);
  countAll();
}

void HeldSets::countAll() {
  counts_.resize(stride_);
  HWY_DYNAMIC_DISPATCH(countColumns)(bits_.data(), words_, stride_, counts_.data());
}

std::size_t HeldSets::unionCount() const {
  std::size_t count = 0;
  for (std::size_t w = 0; w < words_; ++w) {
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < stride_; ++i) any |= bits_[w * stride_ + i];
    count += static_cast<std::size_t>(std::popcount(any));
  }
  return count;
}

std::size_t HeldSets::subsetsOf(std::size_t i) const {
  // The columns of the padding are empty, so they are subsets of every other.
  return HWY_DYNAMIC_DISPATCH(subsetColumns)(bits_.data(), words_, stride_, i) - (stride_ - size());
}

void HeldSets::drop(std::span<const std::size_t> barred) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < size(); ++i)
    if (counts_[i] > 0 && std::find(barred.begin(), barred.end(), names_[i]) == barred.end()) kept.push_back(i);
  if (kept.size() == size()) return;
  const std::size_t stride = (kept.size() + kWidest - 1) / kWidest * kWidest;
  for (std::size_t w = 0; w < words_; ++w) {
    // Moves rows in place: a row's new start and columns never lie after the old ones.
    for (std::size_t k = 0; k < kept.size(); ++k) bits_[w * stride + k] = bits_[w * stride_ + kept[k]];
    std::fill(bits_.begin() + static_cast<std::ptrdiff_t>(w * stride + kept.size()),
              bits_.begin() + static_cast<std::ptrdiff_t>((w + 1) * stride), 0);
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    names_[k] = names_[kept[k]];
    counts_[k] = counts_[kept[k]];
  }
  names_.resize(kept.size());
  stride_ = stride;
  bits_.resize(words_ * stride_);
  counts_.resize(stride_, 0);
}

void HeldSets::take(std::size_t i) {
  HWY_DYNAMIC_DISPATCH(removeColumn)(bits_.data(), words_, stride_, i);
  countAll();
  drop({});
}

}  // namespace cairn::builder
#endif

// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/export.h"

namespace cairn::effects {

/// A material's number, counted from zero by whoever names materials: a place in tables, so keep them dense.
using MaterialId = std::uint16_t;

/// The material an object shows at a place: a terrain's zones.
class CAIRN_EFFECTS_EXPORT MaterialMap {
 public:
  virtual ~MaterialMap() = default;
  /// `place`: world frame. Asked for each contact in each step; must not allocate.
  virtual MaterialId at(const btVector3& place) const = 0;
};

/// One value for each pair of materials, whichever comes first. A default for the pairs that were not set.
template <class Value>
class PairTable {
 public:
  /// A table in which every pair has this value.
  explicit PairTable(Value byDefault = {}) : default_(byDefault) {}

  /// Grows the table to hold both. Quadratic in the greatest number that was set.
  void set(MaterialId a, MaterialId b, Value value) {
    grow(std::size_t(a < b ? b : a) + 1);
    values_[a * size_ + b] = value;
    values_[b * size_ + a] = value;
  }

  /// Whether a value of the table, or its default, is such a one.
  template <class Such>
  bool holds(const Such& isSuch) const {
    return isSuch(default_) || std::any_of(values_.begin(), values_.end(), isSuch);
  }
  /// The pair's value, in either order; the default where none was set. Constant time.
  Value at(MaterialId a, MaterialId b) const { return a < size_ && b < size_ ? values_[a * size_ + b] : default_; }

 private:
  void grow(std::size_t size) {
    if (size <= size_) return;
    std::vector<Value> values(size * size, default_);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j < size_; ++j) values[i * size + j] = values_[i * size_ + j];
    values_ = std::move(values);
    size_ = size;
  }

  Value default_;
  std::size_t size_ = 0;
  std::vector<Value> values_;
};

}  // namespace cairn::effects

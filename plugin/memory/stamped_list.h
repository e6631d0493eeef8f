// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn::bullet {

/// A table of values by number, each computed when first needed. `begin` forgets all values without touching them.
/// Allocates only when the number of entries exceeds all earlier ones.
///
///     list.begin(count);
///     const Value& value = list.get(number, [&] { return compute(number); });
template <class Value>
class StampedList {
 public:
  /// Forgets everything. Precondition of `get`: numbers are below `count`.
  void begin(std::size_t count) {
    if (entries_.size() < count) entries_.resize(count);
    if (++run_ == 0) {  // all stamps are old
      entries_.assign(entries_.size(), {});
      run_ = 1;
    }
  }
  /// The value of `number`, computed by `find()` on the first call. Valid until the next `begin`.
  template <class Find>
  const Value& get(std::uint32_t number, const Find& find) {
    Entry& entry = entries_[number];
    if (entry.run != run_) entry = {find(), run_};
    return entry.value;
  }

 private:
  struct Entry {
    Value value;
    std::uint32_t run = 0;
  };
  std::vector<Entry> entries_;
  std::uint32_t run_ = 0;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn::bullet {

/// What is found out about things that have numbers, each when it is first asked for, until the next `begin`: that
/// forgets everything without touching it. Allocates only for more things than ever before.
template <class Value>
class StampedList {
 public:
  /// Forgets everything. `count`: numbers are below it.
  void begin(std::size_t count) {
    if (entries_.size() < count) entries_.resize(count);
    if (++run_ == 0) {  // all stamps are old
      entries_.assign(entries_.size(), {});
      run_ = 1;
    }
  }
  /// What is known of `number`, or what `find()` finds. Valid until the next `begin`.
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

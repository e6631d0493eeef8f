// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "cairn/core/result.h"
#include "rockfall/ensemble/workers.h"

namespace cairn::rockfall {

/// Memory that processes started from now on share with this one, zeroed, and a count of what is done in it.
class SharedMemory {
 public:
  /// Fails with what the system says.
  static Result<std::unique_ptr<SharedMemory>> create(std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  std::span<std::byte> bytes() const;
  void countOne();
  std::uint64_t counted() const;

 private:
  SharedMemory(void* memory, std::size_t bytes) : memory_(memory), bytes_(bytes) {}

  void* memory_;
  std::size_t bytes_;
};

/// Called now and then with the share of all that is done; nothing more is done once it says no.
using ShareDone = std::function<bool(double done)>;

/// Computes `count` items in `jobs` processes, each into `slots` values of its own: the same for any number of them.
/// `compute(item, values, keepGoing)` is to ask `keepGoing` often. Fails as the first item that fails, and for want of
/// memory or processes.
template <class Value, class Compute>
Result<std::vector<Value>> computeEach(std::size_t count, std::size_t slots, std::uint32_t jobs, const Compute& compute,
                                       const ShareDone& progress) {
  static_assert(std::is_trivially_copyable_v<Value>, "processes hand them on as bytes");
  const auto shared = SharedMemory::create(count * slots * sizeof(Value));
  if (!shared) return shared.error();
  SharedMemory& memory = *shared.value();
  auto* values = reinterpret_cast<Value*>(memory.bytes().data());
  std::uninitialized_value_construct_n(values, count * slots);
  const auto keepGoing = [&] {
    return !progress || progress(static_cast<double>(memory.counted()) / static_cast<double>(count));
  };
  const auto workers = static_cast<std::uint32_t>(std::min<std::size_t>(jobs, count));
  const auto work = [&](std::uint32_t worker) -> Status {
    for (std::size_t item = worker; item < count; item += workers) {
      if (const Status done = compute(item, std::span<Value>(values + item * slots, slots), keepGoing); !done)
        return done;
      memory.countOne();
    }
    return {};
  };
  const Status done = workers > 1 ? inProcesses(workers, work) : workers == 1 ? work(0) : Status();
  if (!done) return done.error();
  if (progress) progress(1);  // the line that workers have written on is this process's to end
  return std::vector<Value>(values, values + count * slots);
}

}  // namespace cairn::rockfall

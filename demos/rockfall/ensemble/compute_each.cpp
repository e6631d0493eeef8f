// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/compute_each.h"

#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>

namespace cairn::rockfall {
namespace {

using Counter = std::atomic<std::uint64_t>;
static_assert(Counter::is_always_lock_free, "processes share it");
// Before the bytes; as much as keeps any value behind it aligned.
constexpr std::size_t kBefore = 64;
static_assert(sizeof(Counter) <= kBefore);

Counter& counterOf(void* memory) {
  return *std::launder(static_cast<Counter*>(memory));
}

}  // namespace

Result<std::unique_ptr<SharedMemory>> SharedMemory::create(std::size_t bytes) {
  void* memory = mmap(nullptr, kBefore + bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    return Error{std::string("cannot get memory for processes to share: ") + std::strerror(errno)};
  new (memory) Counter(0);
  return std::unique_ptr<SharedMemory>(new SharedMemory(memory, bytes));
}

SharedMemory::~SharedMemory() {
  munmap(memory_, kBefore + bytes_);
}

std::span<std::byte> SharedMemory::bytes() const {
  return {static_cast<std::byte*>(memory_) + kBefore, bytes_};
}

void SharedMemory::countOne() {
  counterOf(memory_).fetch_add(1);
}

std::uint64_t SharedMemory::counted() const {
  return counterOf(memory_).load();
}

}  // namespace cairn::rockfall

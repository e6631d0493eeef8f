// SPDX-License-Identifier: Zlib
//
// Memory for Bullet that ends in an exception. Bullet's own allocator returns null, and Bullet writes there.
#include <LinearMath/btAlignedAllocator.h>

#include <cstdlib>
#include <new>

namespace {

void* allocate(std::size_t bytes, int alignment) {
  void* memory = nullptr;
  if (posix_memalign(&memory, static_cast<std::size_t>(alignment), bytes) != 0) throw std::bad_alloc();
  return memory;
}

void deallocate(void* memory) {
  std::free(memory);
}

// Before the first call, so that no memory comes from one allocator and goes to the other.
[[maybe_unused]] const bool isSet = (btAlignedAllocSetCustomAligned(allocate, deallocate), true);

}  // namespace

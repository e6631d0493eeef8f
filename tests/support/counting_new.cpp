// SPDX-License-Identifier: Zlib
#include "counting_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(_WIN32)
#include <malloc.h>
#endif

namespace {
std::atomic<std::size_t> gAllocations{0};
}  // namespace

std::size_t cairn::test::allocations() {
  return gAllocations;
}

#ifdef __SANITIZE_ADDRESS__

bool cairn::test::countsAllocations() {
  return false;
}

#else

bool cairn::test::countsAllocations() {
  return true;
}

namespace {
#if defined(_WIN32)  // where memory with an alignment is freed by a function of its own
void* alignedMemory(std::size_t alignment, std::size_t size) {
  return _aligned_malloc(size, alignment);
}
void release(void* memory) {
  _aligned_free(memory);
}
#else
void* alignedMemory(std::size_t alignment, std::size_t size) {
  return std::aligned_alloc(alignment, size);
}
void release(void* memory) {
  std::free(memory);
}
#endif

void* allocate(std::size_t size, std::size_t alignment) {
  gAllocations.fetch_add(1, std::memory_order_relaxed);
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  if (void* memory = alignedMemory(alignment, rounded == 0 ? alignment : rounded)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t a) {
  return allocate(size, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t size, std::align_val_t a) {
  return allocate(size, static_cast<std::size_t>(a));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "cairn/core/tree_file.h"
#include "random_tree.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

// Starts from real trees instead of waiting for the fuzzer to guess one.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned seed) {
  if (size < 16 || seed % 64 == 0) {
    cairn::test::RandomTree random = cairn::test::randomTree(seed % 5 + 1, 20 + seed % 30, seed % 3);
    if (seed % 2 == 0) cairn::test::addBounds(random, seed);
    auto tree = cairn::SphereTree::create(std::move(random.data));
    const std::vector<std::byte> bytes = cairn::encodeTree(tree.value());
    if (bytes.size() <= maxSize) {
      std::memcpy(data, bytes.data(), bytes.size());
      return bytes.size();
    }
  }
  return LLVMFuzzerMutate(data, size, maxSize);
}

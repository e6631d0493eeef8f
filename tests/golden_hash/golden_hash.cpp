// SPDX-License-Identifier: Zlib
//
// What must be the same bits in every build. Without arguments: prints how the golden heap ends, and fails if that is
// not how it ends everywhere. With two: writes the tree of the first file again into the second. With one: writes a
// tree into it that is generated without the builder, the heap's round one. With --trees and two: the round one and the
// square one.
#include <cinttypes>
#include <cstdio>
#include <string_view>

#include "cairn/core/tree_file.h"
#include "walled_heap.h"

namespace {

int heap() {
  const std::uint64_t hash = cairn::test::goldenHash();
  std::printf("%016" PRIx64 "\n", hash);
  return hash == cairn::test::kGoldenHash ? 0 : 1;
}

int refused(const cairn::Error& error) {
  std::fprintf(stderr, "golden_hash: %s\n", error.message.c_str());
  return 1;
}

int written(const cairn::SphereTree& tree, const char* to) {
  const cairn::Status saved = cairn::saveTree(tree, to);
  return saved ? 0 : refused(saved.error());
}

int rewritten(const char* from, const char* to) {
  const cairn::Result<cairn::SphereTree> tree = cairn::loadTree(from);
  if (!tree) return refused(tree.error());
  return written(tree.value(), to);
}

}  // namespace

int main(int count, char** arguments) {
  using cairn::test::WalledHeap;
  if (count == 4 && std::string_view(arguments[1]) == "--trees")
    return written(*WalledHeap::round(), arguments[2]) + written(*WalledHeap::square(), arguments[3]);
  if (count == 3) return rewritten(arguments[1], arguments[2]);
  return count == 2 ? written(*WalledHeap::round(), arguments[1]) : heap();
}

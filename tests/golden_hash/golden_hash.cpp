// SPDX-License-Identifier: Zlib
//
// What must be the same bits in every build. Without arguments: prints how the golden heap ends, and fails if that is
// not how it ends everywhere. With two: writes the tree of the first file again into the second. With one: writes a
// tree into it that is generated without the builder.
#include <cinttypes>
#include <cstdio>

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

int rewritten(const char* from, const char* to) {
  const cairn::Result<cairn::SphereTree> tree = cairn::loadTree(from);
  if (!tree) return refused(tree.error());
  const cairn::Status saved = cairn::saveTree(tree.value(), to);
  return saved ? 0 : refused(saved.error());
}

int generated(const char* to) {
  const cairn::Status saved = cairn::saveTree(*cairn::test::plainTree(cairn::test::ball(0.3, 6)), to);
  return saved ? 0 : refused(saved.error());
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3) return rewritten(arguments[1], arguments[2]);
  return count == 2 ? generated(arguments[1]) : heap();
}

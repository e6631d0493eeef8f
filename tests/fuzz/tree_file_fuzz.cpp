// SPDX-License-Identifier: Zlib
//
// Feeds the tree loader. A checksum would turn every mutation away at the door, so each input is tried twice: as it is,
// and with its checksum made right, which lets the mutations reach the structural checks and the tree behind them.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "cairn/core/state_hash.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/tree_pair_traversal.h"
#include "cairn_tree_generated.h"

namespace {

using cairn::SphereTree;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

// Whatever is accepted must survive use: written again it is the same tree, and traversals over it end.
void useTree(const SphereTree& tree) {
  const auto again = cairn::decodeTree(cairn::encodeTree(tree));
  require(again.ok(), "an accepted tree could not be read back");
  require(cairn::encodeTree(again.value()) == cairn::encodeTree(tree), "an accepted tree changed on its way");
  cairn::Pose apart;
  apart.translation = {tree.sphere(cairn::kRootNode).radius * 0.5, 0, 0};
  cairn::TreePairTraversal traversal;
  traversal.start(tree, tree, {}, apart, 0);
  cairn::Budget budget = cairn::Budget::operations(20000);
  (void)traversal.refine(budget);
  require(budget.used() <= 20000, "a budget was exceeded");
  for (const cairn::NodePair& pair : traversal.leafPairs()) {
    (void)traversal.mayTouch(pair);
    for (const cairn::NodeId id : {pair.a, pair.b})
      require(id % cairn::kFamilyWidth < tree.familySize(id / cairn::kFamilyWidth), "a dead lane was reported");
  }
}

void mendChecksum(std::vector<std::byte>& bytes) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(bytes.data());
  flatbuffers::Verifier verifier(raw, bytes.size());
  if (bytes.size() < 16 || !cairn::file::TreeBufferHasIdentifier(raw) || !cairn::file::VerifyTreeBuffer(verifier))
    return;
  auto* table = flatbuffers::GetMutableRoot<flatbuffers::Table>(bytes.data());
  std::uint8_t* field = table->GetAddressOf(cairn::file::Tree::VT_CHECKSUM);
  if (field == nullptr) return;
  std::memset(field, 0, 8);
  cairn::StateHash hash;
  hash.add(std::span<const std::byte>(bytes));
  flatbuffers::WriteScalar(field, hash.value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  if (const auto tree = cairn::decodeTree(bytes); tree.ok()) useTree(tree.value());
  mendChecksum(bytes);
  if (const auto tree = cairn::decodeTree(bytes); tree.ok()) useTree(tree.value());
  return 0;
}

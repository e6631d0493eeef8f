// SPDX-License-Identifier: Zlib
#include "cairn/bullet/stored_shapes.h"

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>

#include "cairn/core/tree_file.h"
#include "serialize/file_chunks.h"
#include "serialize/tree_chunks.h"

namespace cairn::bullet {

namespace {

// The chunks of a file by their names: shapes as indices, trees as bytes, records in file order.
struct Contents {
  std::multimap<std::uint64_t, std::size_t> shapes;
  std::map<std::uint64_t, std::span<const std::byte>> trees;
  std::vector<std::span<const std::byte>> records;
};

Contents contentsOf(const std::vector<FileChunk>& chunks) {
  Contents contents;
  std::size_t shapes = 0;
  for (const FileChunk& chunk : chunks) {
    // Bullet's importer counts as shapes only chunks with a structure.
    if (chunk.code == BT_SHAPE_CODE && chunk.structure >= 0) contents.shapes.emplace(chunk.name, shapes++);
    if (chunk.code == kTreeChunk) contents.trees.emplace(chunk.name, chunk.data);
    if (chunk.code == kTreeShapeChunk) contents.records.push_back(chunk.data);
  }
  return contents;
}

Error damaged(std::size_t number, const char* how) {
  return Error{"holds a damaged sphere-tree shape, number " + std::to_string(number) + " (" + how +
               "); write it again"};
}

Result<StoredShape> readRecord(const Contents& contents, std::size_t number, std::uint64_t& treeName) {
  const std::span<const std::byte> bytes = contents.records[number];
  TreeShapeRecord record;
  if (bytes.size() != sizeof record) return damaged(number, "wrong length");
  std::memcpy(&record, bytes.data(), sizeof record);
  if (record.version != kTreeShapeVersion)
    return Error{"holds sphere-tree shapes of version " + std::to_string(record.version) +
                 ", this program reads version " + std::to_string(kTreeShapeVersion) + "; write it again"};
  if (record.frame > static_cast<std::uint32_t>(BodyFrame::mesh)) return damaged(number, "unknown frame");
  if (!(record.margin >= 0) || !std::isfinite(record.margin)) return damaged(number, "impossible margin");
  StoredShape shape;
  const auto [first, last] = contents.shapes.equal_range(record.shapeName);
  for (auto it = first; it != last; ++it) shape.chunks.push_back(it->second);
  if (shape.chunks.empty()) return damaged(number, "no such shape");
  shape.frame = static_cast<BodyFrame>(record.frame);
  shape.scale = record.scale;
  shape.margin = record.margin;
  treeName = record.treeName;
  return shape;
}

}  // namespace

Result<std::vector<StoredShape>> readStoredShapes(std::span<const std::byte> bulletFile) {
  const Result<std::vector<FileChunk>> chunks = chunksOf(bulletFile);
  if (!chunks) return chunks.error();
  const Contents contents = contentsOf(chunks.value());
  std::map<std::uint64_t, std::shared_ptr<const SphereTree>> trees;
  std::vector<StoredShape> shapes;
  for (std::size_t number = 0; number < contents.records.size(); ++number) {
    std::uint64_t treeName = 0;
    Result<StoredShape> shape = readRecord(contents, number, treeName);
    if (!shape) return shape.error();
    const auto stored = contents.trees.find(treeName);
    if (stored == contents.trees.end()) return damaged(number, "no such tree");
    std::shared_ptr<const SphereTree>& tree = trees[treeName];
    if (!tree) {
      Result<SphereTree> decoded = decodeTree(stored->second);
      if (!decoded) return Error{"holds a sphere-tree that " + decoded.error().message};
      tree = std::make_shared<const SphereTree>(std::move(decoded).value());
    }
    shape.value().tree = tree;
    shapes.push_back(std::move(shape).value());
  }
  return shapes;
}

}  // namespace cairn::bullet

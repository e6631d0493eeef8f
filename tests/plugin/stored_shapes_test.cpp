// SPDX-License-Identifier: Zlib
#include "cairn/bullet/stored_shapes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>

#include "bullet_world.h"
#include "cairn/core/tree_file.h"
#include "random_tree.h"
#include "saved_world.h"
#include "serialize/file_chunks.h"
#include "serialize/tree_chunks.h"

namespace cairn::test::stored_shapes_test {
namespace {

using bullet::BodyFrame;
using bullet::readStoredShapes;
using bullet::SphereTreeShape;
using bullet::StoredShape;
using Bytes = std::vector<std::byte>;

std::shared_ptr<SphereTreeShape> principalShape(std::shared_ptr<const SphereTree> tree, btScalar scale) {
  return SphereTreeShape::create(std::move(tree), BodyFrame::principalAxes, scale).value();
}

// Two shapes of one tree, one of another, a box between them.
Bytes savedShapes(const std::shared_ptr<const SphereTree>& a, const std::shared_ptr<const SphereTree>& b) {
  BulletWorld<> w;
  const auto first = principalShape(a, btScalar(1.5));
  first->setMargin(btScalar(0.125));
  w.add(first, 1, btVector3(0, 0, 0));
  w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 1, btVector3(5, 0, 0));
  w.add(treeShape(a, 2), 1, btVector3(0, 5, 0));
  w.add(treeShape(b), 1, btVector3(0, 0, 5));
  w.add(first, 1, btVector3(9, 0, 0));
  return saved(w.world);
}

std::size_t chunkAt(const Bytes& file, const char* letters) {
  for (std::size_t i = 0; i + 4 <= file.size(); ++i)
    if (std::memcmp(&file[i], letters, 4) == 0) return i;
  ADD_FAILURE() << "no chunk " << letters;
  return 0;
}

// Changes the record of the first shape in a file of this machine's pointer size; it need not be aligned there.
template <class Change>
void changeFirstRecord(Bytes& file, const Change& change) {
  std::byte* const at = &file[chunkAt(file, "CTSH") + 16 + sizeof(void*)];
  bullet::TreeShapeRecord record;
  std::memcpy(&record, at, sizeof record);
  change(record);
  std::memcpy(at, &record, sizeof record);
}

TEST(StoredShapes, AreTheShapesThatWereSaved) {
  const auto a = plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3)), b = plainTree(ball(0.3, 5));
  const Bytes file = savedShapes(a, b);
  EXPECT_EQ(countOf(file, "CARN"), 2 * 2) << "one chunk a tree, and each begins with the identifier of a .cairn file";
  const auto shapes = readStoredShapes(file);
  ASSERT_TRUE(shapes.ok()) << shapes.error().message;
  ASSERT_EQ(shapes.value().size(), 3U);
  const std::vector<StoredShape>& s = shapes.value();
  EXPECT_EQ(s[0].tree, s[1].tree) << "shared again";
  EXPECT_EQ(s[0].tree->data(), a->data());
  EXPECT_EQ(s[2].tree->data(), b->data());
  EXPECT_EQ(s[0].frame, BodyFrame::principalAxes);
  EXPECT_EQ(s[1].frame, BodyFrame::mesh);
  EXPECT_EQ(s[0].scale, 1.5);
  EXPECT_EQ(s[1].scale, 2);
  EXPECT_EQ(s[0].margin, 0.125);
  EXPECT_EQ(s[0].chunks, std::vector<std::size_t>{0});
  EXPECT_EQ(s[1].chunks, std::vector<std::size_t>{2}) << "the box is between them";
  EXPECT_EQ(s[2].chunks, std::vector<std::size_t>{3});
}

TEST(StoredShapes, AreNoneInAFileOfOthers) {
  BulletWorld<> w;
  w.addGround();
  const auto shapes = readStoredShapes(saved(w.world));
  ASSERT_TRUE(shapes.ok()) << shapes.error().message;
  EXPECT_TRUE(shapes.value().empty());
}

// Bullet pads nothing, and reads chunk heads where they lie.
TEST(StoredShapes, KeepTheFilesAlignment) {
  for (const char* name : {"", "a", "ab", "abcdefg"}) {
    SphereTreeData data = plainTree(ball(0.3, 3))->data();
    data.info.meshName = name;
    EXPECT_EQ(encodeTree(SphereTree::create(data).value()).size() % 8, 0U);
  }
}

// One body of one tree.
Bytes savedOne(const std::shared_ptr<const SphereTree>& tree) {
  BulletWorld<> w;
  w.add(treeShape(tree), 1, btVector3(0, 0, 0));
  return saved(w.world);
}

TEST(StoredShapes, ACutFileIsRefusedWhereverItIsCut) {
  const auto tree = plainTree(cuboid({1, 2, 3}, 1));
  const Bytes file = savedOne(tree);
  const std::size_t dictionary = chunkAt(file, "DNA1");
  for (std::size_t size = 0; size < file.size(); size += size < dictionary + 64 ? 1 : 997) {
    // Not a view of the file: reading past the end of the cut one has to be seen by the address sanitizer.
    const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    const auto shapes = readStoredShapes(cut);
    // To Bullet, data that end with a chunk are a file without its dictionary.
    if (shapes.ok()) EXPECT_LE(size, dictionary);
  }
  EXPECT_FALSE(readStoredShapes(std::span(file).first(dictionary + 30)).ok());
}

TEST(StoredShapes, DamageToATreeIsFound) {
  const auto tree = plainTree(cuboid({1, 2, 3}, 1));
  const Bytes file = savedOne(tree);
  const std::size_t first = chunkAt(file, "CARN") + 16 + sizeof(void*), size = encodeTree(*tree).size();
  for (std::size_t at = first; at < first + size; ++at) {
    Bytes damaged = file;
    damaged[at] ^= std::byte{1};
    ASSERT_FALSE(readStoredShapes(damaged).ok()) << "byte " << at - first << " of the tree";
  }
}

TEST(StoredShapes, DamageAnywhereDoesNoHarm) {
  const auto tree = plainTree(cuboid({1, 2, 3}, 1));
  const Bytes file = savedOne(tree);
  const std::size_t dictionary = chunkAt(file, "DNA1");
  std::mt19937_64 engine(3);
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes damaged = file;
    for (int k = 0; k < 3; ++k) damaged[engine() % dictionary] = static_cast<std::byte>(engine());
    if (const auto shapes = readStoredShapes(damaged); shapes.ok()) EXPECT_LE(shapes.value().size(), 1U);
  }
}

TEST(StoredShapes, ErrorsNameWhatIsWrong) {
  const Bytes file = savedShapes(plainTree(cuboid({1, 2, 3}, 1)), plainTree(cuboid({1, 1, 1}, 1)));
  const auto refused = [&](auto change, const char* words) {
    Bytes changed = file;
    change(changed);
    const auto shapes = readStoredShapes(changed);
    ASSERT_FALSE(shapes.ok()) << words;
    EXPECT_NE(shapes.error().message.find(words), std::string::npos) << shapes.error().message;
  };
  refused([](Bytes& f) { f[0] = std::byte{'b'}; }, "no .bullet file");
  refused([](Bytes& f) { f[8] = std::byte{'V'}; }, "byte order");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.version = 9; }); }, "version 9");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.frame = 2; }); }, "frame");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.margin = -1; }); }, "margin");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.margin = std::numeric_limits<double>::quiet_NaN(); }); },
          "margin");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.shapeName = 12345; }); }, "no such shape");
  refused([](Bytes& f) { changeFirstRecord(f, [](auto& r) { r.treeName = 12345; }); }, "no such tree");
  refused([](Bytes& f) { f.resize(f.size() / 2); }, "cut short");
}

// By hand, because no 32-bit Bullet is at hand: heads of 20 bytes.
TEST(StoredShapes, ChunksOfA32BitProgramAreRead) {
  Bytes file;
  const auto add = [&](const auto& value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    file.insert(file.end(), bytes, bytes + sizeof value);
  };
  for (const char c : std::string("BULLETf_v324")) file.push_back(static_cast<std::byte>(c));
  for (const std::int32_t value : {BT_SHAPE_CODE, 4, 77, 5, 1, 123456}) add(value);
  for (const std::int32_t value : {bullet::kTreeChunk, 8, 78, -1, 8, 1, 2}) add(value);
  for (const std::int32_t value : {BT_DNA_CODE, 0, 1, 0, 1}) add(value);
  const auto chunks = bullet::chunksOf(file);
  ASSERT_TRUE(chunks.ok()) << chunks.error().message;
  ASSERT_EQ(chunks.value().size(), 2U);
  EXPECT_EQ(chunks.value()[0].code, BT_SHAPE_CODE);
  EXPECT_EQ(chunks.value()[0].name, 77U);
  EXPECT_EQ(chunks.value()[0].structure, 5);
  EXPECT_EQ(chunks.value()[1].data.size(), 8U);
  EXPECT_EQ(chunks.value()[1].name, 78U);
}

}  // namespace
}  // namespace cairn::test::stored_shapes_test

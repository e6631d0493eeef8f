// SPDX-License-Identifier: Zlib
#include "cairn/core/tree_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <optional>

#include "cairn/core/atomic_file.h"
#include "random_tree.h"

namespace cairn::tree_file_test {
namespace {

namespace fs = std::filesystem;

class TreeFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("cairn_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    test::RandomTree random = test::randomTree(21, 60, 2);
    test::addBounds(random, 21);
    SphereTreeData& data = random.data;
    data.info = {"rock.obj", "00ff", "combined", 8, 3, 5000, 42};
    data.origin = {1.5, -2, 1e6};
    data.mass.centerOfMass += data.origin;
    data.faceNormals = {{1, 0, 0}};
    data.nodes[2].normalCount = 1;
    data.levelMeshes = {{data.vertices, data.triangles, 0.25F}, {data.vertices, data.triangles, 0.125F}};
    tree_.emplace(std::move(SphereTree::create(std::move(data))).value());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
  std::optional<SphereTree> tree_;
};

TEST_F(TreeFile, RoundTrip_IsExactAndGivesTheSameBytes) {
  const std::vector<std::byte> bytes = encodeTree(*tree_);
  const Result<SphereTree> back = decodeTree(bytes);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back.value().data(), tree_->data());
  EXPECT_EQ(encodeTree(back.value()), bytes);
}

TEST_F(TreeFile, OneSphereANode_StoresNoBounds) {
  SphereTreeData data = tree_->data();
  const std::vector<std::byte> two = encodeTree(*tree_);
  data.bounds.clear();
  const std::vector<std::byte> one = encodeTree(SphereTree::create(data).value());
  EXPECT_GE(two.size(), one.size() + 16 * data.nodes.size());
  const Result<SphereTree> back = decodeTree(one);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back.value().spheresPerNode(), 1U);
  EXPECT_EQ(back.value().data(), data);
}

TEST_F(TreeFile, SaveAndLoad_LeaveOneFile) {
  const fs::path path = folder_ / "rock.cairn";
  ASSERT_TRUE(saveTree(*tree_, path).ok());
  ASSERT_TRUE(saveTree(*tree_, path).ok()) << "over an existing file";
  EXPECT_EQ(filesInFolder(), 1U);
  const Result<SphereTree> back = loadTree(path);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back.value().data(), tree_->data());
}

TEST_F(TreeFile, Truncated_IsRefusedAtEveryLength) {
  const std::vector<std::byte> bytes = encodeTree(*tree_);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(decodeTree(std::span(bytes).first(size)).ok()) << size << " of " << bytes.size() << " bytes";
}

TEST_F(TreeFile, LongerThanWritten_IsRefused) {
  std::vector<std::byte> bytes = encodeTree(*tree_);
  bytes.resize(bytes.size() + 8);
  EXPECT_FALSE(decodeTree(bytes).ok());
}

TEST_F(TreeFile, AnyFlippedBit_IsRefused) {
  std::vector<std::byte> bytes = encodeTree(*tree_);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] ^= static_cast<std::byte>(1 << bit);
      ASSERT_FALSE(decodeTree(bytes).ok()) << "byte " << i << ", bit " << bit;
      bytes[i] ^= static_cast<std::byte>(1 << bit);
    }
}

TEST_F(TreeFile, OtherVersion_IsNamed) {
  std::vector<std::byte> bytes = encodeTree(*tree_);
  // The version is the only scalar of the root table that equals 1; find it by trying.
  bool named = false;
  for (std::size_t i = 8; i < bytes.size() && !named; ++i) {
    if (bytes[i] != std::byte{1}) continue;
    bytes[i] = std::byte{7};
    const Result<SphereTree> tree = decodeTree(bytes);
    ASSERT_FALSE(tree.ok());
    named = tree.error().message.find("format version 7, this program reads version 1") != std::string::npos;
    bytes[i] = std::byte{1};
  }
  EXPECT_TRUE(named);
}

TEST_F(TreeFile, NotATree_IsNamed) {
  const fs::path path = folder_ / "poem.txt";
  ASSERT_TRUE(writeFileAtomically(path, std::string_view("Two roads diverged in a yellow wood")).ok());
  const Result<SphereTree> tree = loadTree(path);
  ASSERT_FALSE(tree.ok());
  EXPECT_EQ(tree.error().message, path.string() + " is not a Cairn tree; make one with `cairn build`");
}

TEST_F(TreeFile, MissingFileAndFolder_AreNamed) {
  const Result<SphereTree> missing = loadTree(folder_ / "none.cairn");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("cannot read"), std::string::npos);
  EXPECT_NE(loadTree(folder_).error().message.find("it is a folder"), std::string::npos);
}

TEST_F(TreeFile, FailedWrite_LeavesNothing) {
  EXPECT_FALSE(saveTree(*tree_, folder_ / "no" / "such" / "folder" / "rock.cairn").ok());
  fs::create_directory(folder_ / "taken");
  EXPECT_FALSE(saveTree(*tree_, folder_ / "taken").ok()) << "a folder is in the way";
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(TreeFile, WriterThatFails_LeavesTheOldFile) {
  const fs::path path = folder_ / "report.json";
  ASSERT_TRUE(writeFileAtomically(path, std::string_view("old")).ok());
  const Status status = writeFileAtomically(path, [](const fs::path& temporary) -> Status {
    EXPECT_EQ(temporary.extension(), ".json");
    EXPECT_TRUE(writeFileAtomically(temporary, std::string_view("half")).ok());
    return Error{"gave up"};
  });
  EXPECT_EQ(status.error().message, "gave up");
  EXPECT_EQ(filesInFolder(), 1U);
  EXPECT_EQ(readFile(path).value().size(), 3U);
}

}  // namespace
}  // namespace cairn::tree_file_test

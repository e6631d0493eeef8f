// SPDX-License-Identifier: Zlib
//
// Links, pipes and devices, as POSIX has them: not built for Windows.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>

#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "random_tree.h"

namespace cairn::posix_files_test {
namespace {

namespace fs = std::filesystem;

class PosixFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("cairn_posix_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
  const SphereTree tree_ = SphereTree::create(test::randomTree(21, 60, 2).data).value();
};

TEST_F(PosixFiles, Link_IsAskedWhereItLeads) {
  fs::create_symlink(folder_ / "none" / "report.json", folder_ / "lost.json");
  fs::create_symlink("report.json", folder_ / "link.json");
  EXPECT_FALSE(checkWritable(folder_ / "lost.json").ok());
  EXPECT_TRUE(checkWritable(folder_ / "link.json").ok());
  ASSERT_TRUE(writeFileAtomically(folder_ / "link.json", std::string_view("new")).ok());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_TRUE(fs::is_regular_file(folder_ / "report.json"));
}

TEST_F(PosixFiles, LinksInACircle_AreRefused) {
  fs::create_symlink("self.json", folder_ / "self.json");
  fs::create_symlink("second.json", folder_ / "first.json");
  fs::create_symlink("first.json", folder_ / "second.json");
  for (const char* name : {"self.json", "first.json"}) {
    EXPECT_FALSE(checkWritable(folder_ / name).ok());
    EXPECT_FALSE(writeFileAtomically(folder_ / name, std::string_view("new")).ok());
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
  }
}

TEST_F(PosixFiles, Device_IsAskedItself) {
  fs::create_symlink("/dev/null", folder_ / "device");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_TRUE(checkWritable(folder_ / "device").ok());
  EXPECT_TRUE(checkWritable("/dev/null").ok());
  if (geteuid() != 0) EXPECT_FALSE(checkWritable(folder_ / "report.json").ok());
}

TEST_F(PosixFiles, SymbolicLink_StaysAndItsTargetIsWritten) {
  const fs::path target = folder_ / "target.cairn", link = folder_ / "link.cairn";
  ASSERT_TRUE(writeFileAtomically(target, std::string_view("old")).ok());
  fs::create_symlink(target, link);
  ASSERT_TRUE(saveTree(tree_, link).ok());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(loadTree(target).ok());
  EXPECT_EQ(filesInFolder(), 2U);
}

TEST_F(PosixFiles, Pipe_IsWrittenToAndStays) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread reader([&] {
    const Result<std::vector<std::byte>> bytes = readFile(pipe);
    EXPECT_TRUE(bytes.ok() && bytes.value() == encodeTree(tree_));
  });
  EXPECT_TRUE(saveTree(tree_, pipe).ok());
  reader.join();
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_FALSE(writeFileAtomically(pipe, [](const fs::path&) { return Status(); }).ok());
}

}  // namespace
}  // namespace cairn::posix_files_test

// SPDX-License-Identifier: Zlib
#include "cairn/core/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace cairn::atomic_file_test {
namespace {

namespace fs = std::filesystem;

class Writable : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("cairn_writable_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  fs::path folder_;
};

TEST_F(Writable, NewFile_IsNotMadeByAsking) {
  EXPECT_TRUE(checkWritable(folder_ / "report.json").ok());
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Writable, NoNameAndFolderAndMissingFolder_AreRefused) {
  EXPECT_FALSE(checkWritable("").ok());
  EXPECT_FALSE(checkWritable(folder_).ok());
  const Status missing = checkWritable(folder_ / "none" / "report.json");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find((folder_ / "none").string()), std::string::npos);
}

TEST_F(Writable, Link_IsAskedWhereItLeads) {
  fs::create_symlink(folder_ / "none" / "report.json", folder_ / "lost.json");
  fs::create_symlink("report.json", folder_ / "link.json");
  EXPECT_FALSE(checkWritable(folder_ / "lost.json").ok());
  EXPECT_TRUE(checkWritable(folder_ / "link.json").ok());
  ASSERT_TRUE(writeFileAtomically(folder_ / "link.json", std::string_view("new")).ok());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_TRUE(fs::is_regular_file(folder_ / "report.json"));
}

TEST_F(Writable, LinksInACircle_AreRefused) {
  fs::create_symlink("self.json", folder_ / "self.json");
  fs::create_symlink("second.json", folder_ / "first.json");
  fs::create_symlink("first.json", folder_ / "second.json");
  for (const char* name : {"self.json", "first.json"}) {
    EXPECT_FALSE(checkWritable(folder_ / name).ok());
    EXPECT_FALSE(writeFileAtomically(folder_ / name, std::string_view("new")).ok());
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
  }
}

TEST_F(Writable, Device_IsAskedItself) {
  fs::create_symlink("/dev/null", folder_ / "device");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_TRUE(checkWritable(folder_ / "device").ok());
  EXPECT_TRUE(checkWritable("/dev/null").ok());
  if (geteuid() != 0) EXPECT_FALSE(checkWritable(folder_ / "report.json").ok());
}

}  // namespace
}  // namespace cairn::atomic_file_test

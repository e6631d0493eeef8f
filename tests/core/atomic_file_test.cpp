// SPDX-License-Identifier: Zlib
#include "cairn/core/atomic_file.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace cairn::atomic_file_test

// SPDX-License-Identifier: Zlib
// Taking a value without a check that there is one: the same in every build type.
#include "cairn/core/result.h"

#include <gtest/gtest.h>

namespace cairn::test::result_test {
namespace {

TEST(Result, GivesBackWhatItWasGiven) {
  EXPECT_EQ(Result<int>(3).value(), 3);
  EXPECT_EQ(Result<int>(Error{"why"}).error().message, "why");
  EXPECT_EQ(Status(Error{"why"}).error().message, "why");
  EXPECT_TRUE(Status().ok());
}

}  // namespace
}  // namespace cairn::test::result_test

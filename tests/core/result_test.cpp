// SPDX-License-Identifier: Zlib
// Taking a value without a check that there is one: the same in every build type.
#include "cairn/core/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace cairn::test::result_test {
namespace {

TEST(Result_Death, OfAValueThatIsAnErrorTellsTheError) {
  const Result<int> failed = Error{"rock.cairn: no such file"};
  EXPECT_DEATH((void)failed.value(), "unchecked.*rock.cairn: no such file");
  EXPECT_DEATH((void)Result<std::unique_ptr<int>>(Error{"too large"}).value(), "too large");
}

TEST(Result_Death, OfAnErrorThatIsNoneSaysSo) {
  EXPECT_DEATH((void)Result<int>(3).error(), "none");
  EXPECT_DEATH((void)Status().error(), "none");
}

TEST(Result, GivesBackWhatItWasGiven) {
  EXPECT_EQ(Result<int>(3).value(), 3);
  EXPECT_EQ(Result<int>(Error{"why"}).error().message, "why");
  EXPECT_EQ(Status(Error{"why"}).error().message, "why");
  EXPECT_TRUE(Status().ok());
}

}  // namespace
}  // namespace cairn::test::result_test

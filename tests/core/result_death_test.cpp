// SPDX-License-Identifier: Zlib
// What happens to who takes a value without a look at whether there is one: the same in every build type.
#include "cairn/core/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace cairn::test::result_death_test {
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

}  // namespace
}  // namespace cairn::test::result_death_test

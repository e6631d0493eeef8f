// SPDX-License-Identifier: Zlib
// The laws of rock-fall hold whatever a rock weighs and however long a step is.
#include "laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace cairn::test::laws_test {
namespace {

class EveryLaw : public testing::TestWithParam<Law> {};

// Of what it says. Each is exact for a step, so only rounding is left: half of 2^-23 of a velocity in each of up to
// 2000 steps, of which the law takes at least a sixth.
constexpr double kOfTheLaw = 1e-3;

TEST_P(EveryLaw, HoldsForAnyMassAndStep) {
  for (const btScalar mass : kLawMasses)
    for (const btScalar rate : kLawRates)
      EXPECT_NEAR(GetParam().measure({mass, rate}).ratio(), 1, kOfTheLaw)
          << mass << " kg, " << rate << " steps a second";
}
INSTANTIATE_TEST_SUITE_P(Effects, EveryLaw, testing::ValuesIn(everyLaw()), [](const auto& tested) {
  std::string name(tested.param.name);
  std::erase_if(name, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) == 0; });
  return name;
});

}  // namespace
}  // namespace cairn::test::laws_test

// SPDX-License-Identifier: Zlib
// Rules for every effect: not listed, of no strength or with nothing to act on it leaves every bit of a simulation
// as it is; where it is listed decides nothing; it allocates nothing once a scene runs; twice the same, whatever else
// the world holds; and what only takes energy never gives any.
#include <gtest/gtest.h>

#include <algorithm>

#include "counting_new.h"
#include "every_effect.h"
#include "rock_slope.h"

namespace cairn::test::generic_test {
namespace {

constexpr int kSteps = 360;

class EveryEffect : public testing::TestWithParam<EffectRow> {};
/// Those there may be nothing to act on for; those that only take energy.
class EffectWithACriterion : public EveryEffect {};
class DissipativeEffect : public EveryEffect {};

template <class Wanted>
std::vector<EffectRow> effectsThat(const Wanted& wanted) {
  std::vector<EffectRow> rows = everyEffect();
  std::erase_if(rows, [&](const EffectRow& row) { return !wanted(row); });
  return rows;
}

std::string nameOf(const testing::TestParamInfo<EffectRow>& info) {
  return info.param.name;
}

std::string hashWith(const EffectRow::Make& make, const RockSlope::Options& options = {}) {
  RockSlope scene(options);
  if (make) scene.set->add(make());
  return scene.runAndHash(kSteps);
}

std::string hashWithoutSet() {
  static const std::string hash = hashWith(nullptr, {.hasSet = false});
  return hash;
}

// The most that the energy rises above what it has been before, J.
double greatestRise(RockSlope& scene) {
  double least = scene.energy(), rise = 0;
  for (int i = 0; i < kSteps; ++i) {
    scene.run(1);
    rise = std::max(rise, scene.energy() - least);
    least = std::min(least, scene.energy());
  }
  return rise;
}

TEST(NoEffect, NotListedIsAbsent) {
  EXPECT_EQ(hashWith(nullptr), hashWithoutSet());
}

TEST_P(EveryEffect, ActsWhereItsCriterionIsMet) {
  RockSlope scene({});
  scene.set->add(GetParam().active());
  const std::string hash = scene.runAndHash(kSteps);
  EXPECT_GT(scene.set->report().front().acted, 0U);
  EXPECT_EQ(hash != hashWithoutSet(), GetParam().changesMotion);
}

TEST_P(EveryEffect, OfNoStrengthIsOff) {
  ASSERT_FALSE(GetParam().zeros.empty());
  for (const auto& [parameter, zero] : GetParam().zeros) {
    EXPECT_EQ(hashWith(zero, {.isSmooth = true}), hashWith(nullptr, {.isSmooth = true})) << parameter;
    // Friction of zero is smooth, which bodies with a friction of their own are not without it.
    if (GetParam().name != "friction") EXPECT_EQ(hashWith(zero), hashWithoutSet()) << parameter;
  }
}

TEST_P(EffectWithACriterion, MetByNothingIsOff) {
  RockSlope scene({});
  scene.set->add(GetParam().idle());
  EXPECT_EQ(scene.runAndHash(kSteps), hashWithoutSet());
  EXPECT_EQ(scene.set->report().front().acted, 0U);
}

TEST_P(EveryEffect, IsTheSameTwiceAndWithStrangersFarAway) {
  const std::string once = hashWith(GetParam().active);
  EXPECT_EQ(hashWith(GetParam().active), once);
  EXPECT_EQ(hashWith(GetParam().active, {.hasStrangers = true}), once);
}

// Beside every other, before and after it.
TEST_P(EveryEffect, MayBeListedAnywhere) {
  const auto both = [](const EffectRow& first, const EffectRow& second) {
    RockSlope scene({});
    scene.set->add(first.active());
    scene.set->add(second.active());
    return scene.runAndHash(kSteps);
  };
  for (const EffectRow& other : everyEffect())
    if (other.name < GetParam().name) EXPECT_EQ(both(GetParam(), other), both(other, GetParam())) << other.name;
}

TEST_P(DissipativeEffect, NeverGivesEnergy) {
  RockSlope scene({});
  scene.set->add(GetParam().active());
  // Bullet pushes bodies out of each other, which lifts them, and a body that turns in the air has its energy rounded:
  // the effect may not add to that.
  RockSlope plain({});
  const double start = plain.energy();
  EXPECT_LE(greatestRise(scene), greatestRise(plain) + 0.005 * start);
}

TEST_P(EveryEffect, AllocatesNothingOnceItRuns) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  RockSlope scene({});
  scene.set->add(GetParam().active());
  // Rooms grow with what a step has of contacts, and no two throws are the same.
  for (int i = 0; i < 8; ++i) {
    scene.run(kSteps);
    scene.throwAgain();
  }
  const std::size_t before = allocations();
  scene.run(kSteps);
  EXPECT_EQ(allocations() - before, 0U);
}

INSTANTIATE_TEST_SUITE_P(Effects, EveryEffect, testing::ValuesIn(everyEffect()), nameOf);
INSTANTIATE_TEST_SUITE_P(Effects, EffectWithACriterion,
                         testing::ValuesIn(effectsThat([](const EffectRow& row) { return bool(row.idle); })), nameOf);
INSTANTIATE_TEST_SUITE_P(Effects, DissipativeEffect,
                         testing::ValuesIn(effectsThat([](const EffectRow& row) { return row.dissipates; })), nameOf);

}  // namespace
}  // namespace cairn::test::generic_test

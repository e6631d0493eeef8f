// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/contact_accuracy.h"

#include <gtest/gtest.h>

#include "scenes/heap/interpenetration.h"
#include "test_solids.h"

namespace cairn::scenes::contact_accuracy_test {
namespace {

constexpr double kRounding = 1e-6;  // single-precision poses about a metre from the origin

/// Two unit cubes, the second moved along x. Size is 2, so that fractions differ from lengths.
class TwoCubes : public ::testing::Test {
 protected:
  TwoCubes() {
    const test::Solid cube = test::cuboid({1, 1, 1}, 1);
    model_.size = 2;
    model_.vertices = cube.vertices;
    model_.triangles = cube.triangles;
    auto surface = ExactSurface::create(cube.vertices, cube.triangles);
    surface_ = std::make_unique<ExactSurface>(std::move(surface).value());
  }

  FrameTruth apart(double distance) const {
    BodyMotion motions[2];
    for (BodyMotion& motion : motions) motion.pose.setIdentity();
    motions[1].pose.setOrigin(toBullet({distance, 0.25, 0.125}));
    return FrameTruth(*surface_, model_, motions);
  }

  ContactAccuracy judged(FrameTruth truth, const std::vector<ReportedContact>& contacts,
                         const StepRecord& record = {}) const {
    AccuracyJudge judge(model_.size);
    judge.judge(truth, contacts, record);
    return judge.result();
  }

  Model model_;
  std::unique_ptr<ExactSurface> surface_;
};

TEST_F(TwoCubes, APairThatMeetsAndIsNotReportedIsMissedAsDeepAsItIs) {
  const ContactAccuracy silent = judged(apart(0.9), {});
  EXPECT_EQ(silent.truePairs, 1U);
  EXPECT_EQ(silent.missed, 1U);
  EXPECT_NEAR(silent.deepestMissed, 0.1 / 2, kRounding + kDepthToleranceFraction);
  EXPECT_EQ(silent.missedBeyondCertificate, 0U) << "no sphere-tree, no certificate";
}

TEST_F(TwoCubes, AMissedPairIsHeldAgainstTheCertificateOfItsFrame) {
  StepRecord record;
  record.tree.emplace();
  record.tree->worstErrorFraction = 0.06;
  EXPECT_EQ(judged(apart(0.9), {}, record).missedBeyondCertificate, 0U);
  record.tree->worstErrorFraction = 0.04;
  EXPECT_EQ(judged(apart(0.9), {}, record).missedBeyondCertificate, 1U);
}

TEST_F(TwoCubes, AReportedPairThatDoesNotMeetIsFalseByItsGap) {
  const ContactAccuracy found = judged(apart(1.1), {{1, 0, {0.6, 0, 0}, {0.5, 0, 0}}});
  EXPECT_EQ(found.truePairs, 0U);
  EXPECT_EQ(found.reportedPairs, 1U);
  EXPECT_EQ(found.missed, 0U);
  ASSERT_EQ(found.falseGap.pairs, 1U);
  EXPECT_NEAR(found.falseGap.max, 0.1 / 2, kRounding);
  EXPECT_NEAR(found.error.max, 0, kRounding) << "both points are on their meshes";
}

TEST_F(TwoCubes, TheErrorOfAPointIsThatOfItsFartherEnd) {
  // 0.03 and 0.2 off the faces, both outside.
  const ContactAccuracy found = judged(apart(1.5), {{0, 1, {0.53, 0.25, 0}, {0.8, 0.25, 0}}});
  EXPECT_NEAR(found.meanError, 0.2 / 2, kRounding);
  EXPECT_NEAR(found.error.max, 0.2 / 2, kRounding);
  EXPECT_NEAR(found.meanStray, 0.03 / 2, kRounding);
}

TEST_F(TwoCubes, ManyPointsOfOnePairAreOnePairAndManyErrors) {
  const ReportedContact exact{0, 1, {0.5, 0, 0}, {0.4, 0.25, 0}}, wrong{1, 0, {0.4, 0.25, 0}, {0.7, 0, 0}};
  const ContactAccuracy found = judged(apart(0.9), {exact, exact, exact, wrong});
  EXPECT_EQ(found.reportedPairs, 1U);
  EXPECT_EQ(found.missed, 0U);
  EXPECT_NEAR(found.meanError, 0.2 / 2 / 4, kRounding);
  EXPECT_NEAR(found.error.median, 0, kRounding);
}

TEST_F(TwoCubes, AMissedPairErrsByItsDepthAloneAndPointsElsewhereDoNot) {
  const ContactAccuracy silent = judged(apart(0.9), {});
  EXPECT_NEAR(silent.meanMissed, 0.1 / 2, kRounding + kDepthToleranceFraction);
  EXPECT_EQ(silent.meanMissed, silent.meanPairError);
  EXPECT_EQ(silent.meanError, 0) << "there are no points";
  // Off the faces by 0.03 and 0.2.
  const ContactAccuracy told = judged(apart(0.9), {{0, 1, {0.53, 0.25, 0}, {0.2, 0.25, 0}}});
  EXPECT_NEAR(told.meanPairError, 0.2 / 2, kRounding);
  EXPECT_EQ(told.meanMissed, 0);
}

TEST_F(TwoCubes, ManyExactPointsDoNotHideAWrongOne) {
  const ReportedContact exact{0, 1, {0.5, 0, 0}, {0.4, 0.25, 0}}, wrong{1, 0, {0.4, 0.25, 0}, {0.7, 0, 0}};
  const ContactAccuracy few = judged(apart(0.9), {exact, wrong});
  const ContactAccuracy many = judged(apart(0.9), {exact, exact, exact, exact, exact, wrong});
  EXPECT_LT(many.meanError, few.meanError) << "points alone can be outweighed";
  EXPECT_EQ(many.meanPairError, few.meanPairError);
  EXPECT_NEAR(many.meanPairError, 0.2 / 2, kRounding);
}

TEST_F(TwoCubes, APairThatIsApartErrsByItsGapHoweverRightItsPoints) {
  const ContactAccuracy found = judged(apart(1.1), {{1, 0, {0.6, 0, 0}, {0.5, 0, 0}}});
  EXPECT_NEAR(found.meanError, 0, kRounding);
  EXPECT_NEAR(found.meanPairError, 0.1 / 2, kRounding);
  EXPECT_NEAR(found.pairError.max, 0.1 / 2, kRounding);
}

}  // namespace
}  // namespace cairn::scenes::contact_accuracy_test

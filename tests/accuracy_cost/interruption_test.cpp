// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "accuracy_cost/experiments/experiment.h"
#include "accuracy_cost/experiments/interrupted_frame.h"
#include "accuracy_cost/experiments/interruption_claims.h"
#include "accuracy_cost/experiments/interruption_table.h"
#include "accuracy_cost/models/solids.h"
#include "cairn/builder/build.h"
#include "scenes/converge/converge.h"

namespace cairn::accuracy_cost::interruption_test {
namespace {

constexpr std::uint64_t kToTheEnd = Budget::kUnlimited;

/// Small tori that fly at each other, and what the exact check says of them.
class InterruptedTori : public ::testing::Test {
 protected:
  InterruptedTori()
      : model_(modelBy(builder::Method::octree, false)),
        recording_(scenes::recordConverge(model_, {.bodies = 6, .runs = 1, .frames = 200}).value()),
        surface_(scenes::ExactSurface::create(model_.vertices, model_.triangles).value()) {}

  static scenes::Model modelBy(builder::Method method, bool twoSpheres) {
    builder::BuildOptions options;
    options.method = method;
    options.depth = 2;
    options.samples = 1000;
    options.twoSpheres = twoSpheres;
    SphereTree tree = builder::buildTree(torus(1, 0.4, 16, 8), options).value();
    return scenes::makeModel(std::make_shared<const SphereTree>(std::move(tree)), 1);
  }
  void expectNeverBeyondAndNeverMissed(const scenes::Model& model) const;

  scenes::Model model_;
  scenes::Recording recording_;
  scenes::ExactSurface surface_;
};

void InterruptedTori::expectNeverBeyondAndNeverMissed(const scenes::Model& model) const {
  InterruptedFrame traversals(model);
  const std::vector<std::uint64_t> operations{0, 50, 200, 1000, kToTheEnd};
  std::uint32_t checked = 0, meeting = 0, unresolved = 0;
  for (std::uint32_t frame = 0; frame < recording_.framesPerRun; frame += 20) {
    const auto motions = recording_.frame(0, frame);
    const scenes::FrameTruth truth(surface_, model, motions);
    const auto found = traversals.interrupt(motions, operations, &truth);
    ASSERT_EQ(found.size(), operations.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LE(found[i].operations, operations[i]);
      EXPECT_EQ(found[i].truth.beyondCertificate, 0U) << "frame " << frame << ", " << operations[i];
      EXPECT_EQ(found[i].truth.missed, 0U) << "frame " << frame << ", " << operations[i];
      EXPECT_GE(found[i].worst, found[i].rms);
      EXPECT_GE(found[i].mean, found[i].best);
      checked += found[i].truth.checked;
      meeting += found[i].truth.meeting;
      unresolved += found[i].isResolved ? 0 : 1;
    }
    EXPECT_TRUE(found.back().isResolved);
  }
  EXPECT_GT(checked, 100U) << "the frames show nothing";
  EXPECT_GT(meeting, 0U);
  EXPECT_GT(unresolved, 0U);
}

TEST_F(InterruptedTori, AreNeverFartherApartThanCertifiedAndNeverMissed) {
  expectNeverBeyondAndNeverMissed(model_);
}

TEST_F(InterruptedTori, OfTwoSpheresANodeAreNeverFartherApartThanCertifiedAndNeverMissed) {
  expectNeverBeyondAndNeverMissed(modelBy(builder::Method::hybrid, true));
}

// The smallest spheres alone find the same pairs, and say more of them with a greater error.
TEST_F(InterruptedTori, OfTwoSpheresANodeErrLessThanTheirBoundsAlone) {
  const scenes::Model two = modelBy(builder::Method::hybrid, true),
                      bounds = modelBy(builder::Method::gridVolume, false);
  InterruptedFrame ofTwo(two), ofBounds(bounds);
  std::uint64_t answers = 0, answersOfBounds = 0;
  double error = 0, errorOfBounds = 0;
  for (std::uint32_t frame = 0; frame < recording_.framesPerRun; frame += 4) {
    const auto motions = recording_.frame(0, frame);
    const Interrupted a = ofTwo.interrupt(motions, std::vector{kToTheEnd}, nullptr).front();
    const Interrupted b = ofBounds.interrupt(motions, std::vector{kToTheEnd}, nullptr).front();
    EXPECT_LE(a.spherePairs, b.spherePairs) << "frame " << frame;
    EXPECT_LE(a.worst, b.worst) << "frame " << frame;
    answers += a.spherePairs;
    answersOfBounds += b.spherePairs;
    error += a.worst;
    errorOfBounds += b.worst;
  }
  EXPECT_GT(answers, 100U) << "the frames show nothing";
  EXPECT_LT(answers, answersOfBounds);
  EXPECT_LT(error, 0.9 * errorOfBounds);
}

TEST_F(InterruptedTori, AnswerTheSameWhateverOtherInterruptionsThereAre) {
  InterruptedFrame traversals(model_);
  for (std::uint32_t frame = 100; frame < recording_.framesPerRun; frame += 30) {
    const auto motions = recording_.frame(0, frame);
    const std::vector<std::uint64_t> many{50, 100, 200, 500, kToTheEnd}, two{200, kToTheEnd};
    const auto all = traversals.interrupt(motions, many, nullptr);
    const auto some = traversals.interrupt(motions, two, nullptr);
    EXPECT_EQ(all[2].worst, some[0].worst);
    EXPECT_EQ(all[2].spherePairs, some[0].spherePairs);
    EXPECT_EQ(all[4].mean, some[1].mean);
    EXPECT_EQ(all[4].spherePairs, some[1].spherePairs);
  }
}

Interrupted outcome(double error, std::uint64_t pairs, bool isResolved) {
  Interrupted frame;
  frame.worst = frame.rms = frame.mean = frame.best = error;
  frame.spherePairs = pairs;
  frame.isResolved = isResolved;
  return frame;
}

TEST(InterruptionTable, AveragesRatiosFrameByFrame) {
  const TreeOutcome reference{
      "hubbard",
      {{outcome(1, 10, false)}, {outcome(4, 10, false)}, {outcome(2, 10, false)}, {outcome(0, 0, true)}},
      {{}}};
  // A quarter, then a half; then nothing, which has no error; then what the reference does not report.
  const TreeOutcome tree{
      "merge", {{outcome(0.25, 5, true)}, {outcome(2, 1, false)}, {outcome(0, 0, true)}, {outcome(9, 3, true)}}, {{}}};
  Table table = emptyInterruptionTable();
  addInterruptionRows(table, "bunny", {500}, {reference, tree});
  const Where where{{"construction", "merge"}};
  EXPECT_EQ(table.value(ratioColumn("hubbard", "worst"), where), (0.25 + 0.5) / 2);
  EXPECT_EQ(table.value(ratioColumn("hubbard", "sphere_pairs"), where), (0.5 + 0.1 + 0) / 3);
  EXPECT_EQ(table.value("unresolved_frames_share", where), 0.25);
  EXPECT_EQ(table.value(ratioColumn("hubbard", "unresolved"), where), 0.25 / 0.75);
  EXPECT_TRUE(table.numbers(ratioColumn("octree", "worst"), where).empty()) << "there is no such tree";
}

/// Every tree of the thesis in one frame, `share` times as bad as its reference in everything but the best error.
std::vector<Claim> claimsOf(double share, double best, std::uint32_t missed = 0,
                            const std::vector<std::string>& models = {"bunny", "dragon"}) {
  const auto frames = [&](double factor, double bestError) {
    InterruptedFrames list;
    for (int i = 0; i < 100; ++i) {
      Interrupted frame = outcome(factor, static_cast<std::uint64_t>(1000 * factor), i >= 100 * factor);
      frame.best = bestError;
      frame.truth.checked = 1;
      frame.truth.missed = missed;
      list.push_back({frame, frame});
    }
    return list;
  };
  std::vector<TreeOutcome> trees;
  for (const char* name : {"hubbard", "octree"}) trees.push_back({name, frames(1, 1), {{}, {}}});
  for (const char* name : {"merge", "expand", "combined", "combined optimised", "grid"})
    trees.push_back({name, frames(share, best), {{}, {}}});
  for (const char* name : {"hybrid", kTwoSpheres}) trees.push_back({name, frames(share / 2, best), {{}, {}}});
  Table table = emptyInterruptionTable();
  for (const std::string& model : models) addInterruptionRows(table, model, {15000, kToTheEnd}, trees);
  return judgeInterruption(table);
}

TEST(Verdict, OfInterruptionTurnsWithTheData) {
  EXPECT_EQ(verdictOf(claimsOf(0.2, 1.1)), Verdict::reproduced) << whyText(claimsOf(0.2, 1.1));
  EXPECT_EQ(claimsOf(0.2, 1.1).size(), 12U);
  EXPECT_EQ(verdictOf(claimsOf(0.2, 1.1, 0, {"bunny"})), Verdict::inPart) << "some claims name the dragon";
  const auto half = claimsOf(0.5, 1.1);
  EXPECT_EQ(verdictOf(half), Verdict::inPart);
  EXPECT_FALSE(half[0].holds) << "a half is not a fifth";
  EXPECT_TRUE(half[2].holds) << "combined is to come down to a half";
  EXPECT_EQ(std::ranges::count(claimsOf(0.2, 0.9), false, &Claim::holds), 1) << "the best error is lower";
  EXPECT_EQ(std::ranges::count(claimsOf(0.2, 1.1, 1), false, &Claim::holds), 1) << "bodies that meet are missed";
}

}  // namespace
}  // namespace cairn::accuracy_cost::interruption_test

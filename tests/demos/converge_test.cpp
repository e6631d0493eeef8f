// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/converge.h"

#include <gtest/gtest.h>

#include <string>

#include "scene_trees.h"
#include "scenes/converge/converge_run.h"
#include "scenes/heap/interpenetration.h"
#include "shape_names.h"

namespace cairn::scenes::converge_test {
namespace {

ConvergeOptions fewBodies(Meeting meeting) {
  ConvergeOptions options;
  options.bodies = 8;
  options.runs = 2;
  options.frames = 180;
  options.meeting = meeting;
  return options;
}

const Model& rock() {
  static const Model model = makeModel(test::smallRockTree(), 1.0);
  return model;
}

Recording record(const ConvergeOptions& options) {
  auto recording = recordConverge(rock(), options);
  EXPECT_TRUE(recording) << recording.error().message;
  return std::move(recording).value();
}

class ConvergeMeeting : public ::testing::TestWithParam<Meeting> {};

TEST_P(ConvergeMeeting, StartsOnASphereWithoutTouchingAndFliesToItsCentre) {
  const Recording recording = record(fewBodies(GetParam()));
  for (std::uint32_t run = 0; run < recording.runs; ++run) {
    const auto start = recording.frame(run, 0), later = recording.frame(run, 60);
    const double radius = start[0].pose.getOrigin().length();
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vec3d place = fromBullet(start[i].pose.getOrigin()), velocity = fromBullet(start[i].linearVelocity);
      EXPECT_NEAR(length(place), radius, 1e-5);
      EXPECT_NEAR(dot(normalized(place), normalized(velocity)), -1, 1e-6);
      EXPECT_LT(later[i].pose.getOrigin().length(), radius);
      for (std::size_t j = i + 1; j < start.size(); ++j)
        EXPECT_GT(distance(place, fromBullet(start[j].pose.getOrigin())), 2 * rock().reach);
    }
  }
}

TEST_P(ConvergeMeeting, GivesTheSameBitsForTheSameSeedAndOthersForAnother) {
  ConvergeOptions options = fewBodies(GetParam());
  const std::string hash = record(options).hash();
  EXPECT_EQ(record(options).hash(), hash);
  options.seed = 2;
  EXPECT_NE(record(options).hash(), hash);
}
INSTANTIATE_TEST_SUITE_P(Converge, ConvergeMeeting, ::testing::Values(Meeting::through, Meeting::bounce),
                         [](const auto& meeting) { return std::string(meetingName(meeting.param)); });

TEST(Converge_Through, NothingTurnsABody) {
  const Recording recording = record(fewBodies(Meeting::through));
  for (std::uint32_t frame = 0; frame < recording.framesPerRun; ++frame)
    for (std::uint32_t i = 0; i < recording.bodies; ++i)
      EXPECT_EQ(recording.frame(1, frame)[i].linearVelocity, recording.frame(1, 0)[i].linearVelocity);
}

TEST(Converge_Bounce, BodiesKeepTheirMomentumTogetherAndStayOutOfEachOther) {
  const Recording recording = record(fewBodies(Meeting::bounce));
  const auto momentum = [&](std::uint32_t frame) {
    btVector3 sum(0, 0, 0);
    for (const BodyMotion& motion : recording.frame(0, frame)) sum += motion.linearVelocity;
    return fromBullet(sum);
  };
  // Thousands of impulses in single precision on bodies of 1 kg and a few m/s.
  EXPECT_NEAR(distance(momentum(0), momentum(recording.framesPerRun - 1)), 0, 1e-3);
  EXPECT_NE(recording.frame(0, 0)[0].linearVelocity, recording.frame(0, recording.framesPerRun - 1)[0].linearVelocity);
  const auto surface = ExactSurface::create(rock().vertices, rock().triangles);
  ASSERT_TRUE(surface);
  std::vector<btTransform> poses;
  for (const BodyMotion& motion : recording.frame(0, recording.framesPerRun - 1)) poses.push_back(motion.pose);
  // GImpact lets fast bodies in by what they move in a step or two.
  EXPECT_LT(worstPenetration(surface.value(), rock(), poses), 0.1);
}

/// Hashes what it is shown.
class Witness final : public Player {
 public:
  explicit Witness(std::vector<Recording>& seen) : seen_(seen) {}
  Status begin() override {
    seen_.push_back({});
    return {};
  }
  StepRecord show(std::span<const BodyMotion> motions) override {
    seen_.back().motions.insert(seen_.back().motions.end(), motions.begin(), motions.end());
    return {};
  }
  std::vector<ReportedContact> contacts() const override { return {}; }

 private:
  std::vector<Recording>& seen_;
};

TEST(Converge_EveryPlayer, SeesTheSamePosesRunByRun) {
  const Recording recording = record(fewBodies(Meeting::through));
  std::vector<Recording> seen[2];
  std::vector<std::unique_ptr<Player>> players;
  for (auto& of : seen) players.push_back(std::make_unique<Witness>(of));
  const auto reports = playRecording(recording, rock(), players, 7);
  ASSERT_TRUE(reports);
  for (const auto& of : seen) {
    ASSERT_EQ(of.size(), recording.runs);
    Recording together;
    for (const Recording& run : of)
      together.motions.insert(together.motions.end(), run.motions.begin(), run.motions.end());
    EXPECT_EQ(together.hash(), recording.hash());
  }
  EXPECT_EQ(reports.value()[0].accuracy.frames, 2 * ((180U + 6) / 7));
  EXPECT_EQ(reports.value()[0].accuracy.missed, reports.value()[0].accuracy.truePairs) << "a witness reports nothing";
  EXPECT_GT(reports.value()[0].accuracy.truePairs, 0U);
}

TEST(Converge_AWorldThatIsShownAFrame, HasExactlyItsPoses) {
  const Recording recording = record(fewBodies(Meeting::bounce));
  for (const ShapeKind shape : {ShapeKind::tree, ShapeKind::gimpact, ShapeKind::hull}) {
    WorldOptions options;
    options.shape = shape;
    auto body = BodyShape::create(shape, rock(), {});
    auto world = World::create(options);
    ASSERT_TRUE(body && world);
    for (std::uint32_t i = 0; i < recording.bodies; ++i)
      world.value()->addBody(body.value()->bullet(), btTransform::getIdentity(), 1, rock().inertia);
    const auto frame = recording.frame(1, 100);
    world.value()->show(frame);
    Recording shown{recording.bodies, 1, 1, world.value()->motions()};
    Recording expected{recording.bodies, 1, 1, {frame.begin(), frame.end()}};
    EXPECT_EQ(shown.hash(), expected.hash()) << shapeName(shape);
  }
}

class ConvergeShape : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(ConvergeShape, MissesNothingDeepAndIsAsWrongAsItsKindIs) {
  WorldOptions options;
  options.shape = GetParam();
  ConvergeOptions scene = fewBodies(Meeting::bounce);
  std::vector<std::unique_ptr<Player>> players;
  auto player = makePlayer(rock(), scene.bodies, options, {});
  if (!player) {
    // Only peers whose library was not there at build time; `cairn.sh test` installs both.
    EXPECT_TRUE(GetParam() == ShapeKind::fcl || GetParam() == ShapeKind::compound) << player.error().message;
    EXPECT_NE(player.error().message.find("install lib"), std::string::npos) << player.error().message;
    return;
  }
  players.push_back(std::move(player).value());
  const auto reports = playRecording(record(scene), rock(), players, 5);
  ASSERT_TRUE(reports);
  const ContactAccuracy& accuracy = reports.value()[0].accuracy;
  ASSERT_GT(accuracy.truePairs, 0U);
  EXPECT_EQ(accuracy.missed, 0U) << "each of these shapes holds the whole mesh";
  EXPECT_EQ(accuracy.missedBeyondCertificate, 0U);
  EXPECT_EQ(accuracy.truePairs + accuracy.falseGap.pairs, accuracy.reportedPairs);
  EXPECT_GE(accuracy.meanError, accuracy.meanStray);
  EXPECT_EQ(reports.value()[0].records.size(), scene.runs * scene.frames);
  if (GetParam() == ShapeKind::tree) {
    // Of the gap along a contact's normal and the distance of the meshes; half a hundredth of the size is what
    // spheres leave.
    EXPECT_LT(accuracy.meanError, 0.0005);
  }
  if (GetParam() == ShapeKind::fcl) {
    EXPECT_EQ(accuracy.falseGap.pairs, 0U);
    // FCL gives a point where two triangles cross, in double precision.
    EXPECT_LT(accuracy.stray.max, 1e-6);
  }
}
INSTANTIATE_TEST_SUITE_P(Converge, ConvergeShape, ::testing::ValuesIn(kShapeKinds), test::shapeTestName);

TEST(Converge_Cancelled, SaysSo) {
  std::vector<Recording> seen;
  std::vector<std::unique_ptr<Player>> players;
  players.push_back(std::make_unique<Witness>(seen));
  const auto reports =
      playRecording(record(fewBodies(Meeting::through)), rock(), players, 50, [](double) { return false; });
  ASSERT_FALSE(reports);
  EXPECT_EQ(reports.error().message, builder::kCancelled);
}

}  // namespace
}  // namespace cairn::scenes::converge_test

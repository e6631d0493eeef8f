// SPDX-License-Identifier: Zlib
#include "dispatch/mesh_time.h"

#include <gtest/gtest.h>

namespace cairn::bullet::mesh_time_test {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint64_t kOperations = 1000;

// Steps of forty pairs that each took so long.
void learn(MeshTime& time, nanoseconds each, int steps) {
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < 40; ++i) time.took(kOperations, each);
    time.endStep();
  }
}

TEST(MeshTime, IsWhatMeshesTook) {
  MeshTime time;
  learn(time, nanoseconds(50000), 200);
  EXPECT_NEAR(time.expected(kOperations), 50000, 500);
  EXPECT_LT(time.expected(kOperations / 4), 25000);
}

TEST(MeshTime, OfAFirstQuestionIsThatOfOthers) {
  MeshTime time;
  learn(time, nanoseconds(50000), 200);
  for (int i = 0; i < 200; ++i) time.learnFirst(3 * kOperations);
  EXPECT_NEAR(time.expected(std::nullopt), time.expected(3 * kOperations), 100);
}

// A machine that was busy once asks no meshes for a while, but not for ever.
TEST(MeshTime, IsHopedToBeLessWhereNothingIsAsked) {
  MeshTime time;
  learn(time, nanoseconds(50000), 200);
  learn(time, nanoseconds(5000000), 20);
  const double slow = time.expected(kOperations);
  EXPECT_GT(slow, 1e6);
  for (int step = 0; step < 2000; ++step) {
    time.wasRefused(true);
    time.endStep();
  }
  EXPECT_LT(time.expected(kOperations), slow / 4);
  const double quiet = time.expected(kOperations);
  time.endStep();
  EXPECT_EQ(time.expected(kOperations), quiet) << "in a step that asked for none";
}

// Small pairs are asked, a large one was asked first once.
TEST(MeshTime, OfAFirstQuestionIsHopedToBeLessToo) {
  MeshTime time;
  for (int i = 0; i < 200; ++i) time.learnFirst(100 * kOperations);
  const double large = time.expected(std::nullopt);
  for (int step = 0; step < 2000; ++step) {
    for (int i = 0; i < 10; ++i) time.took(kOperations, nanoseconds(static_cast<long>(time.expected(kOperations))));
    time.wasRefused(false);
    time.endStep();
  }
  EXPECT_LT(time.expected(std::nullopt), large / 4);
}

}  // namespace
}  // namespace cairn::bullet::mesh_time_test

// SPDX-License-Identifier: Zlib
#include "contacts/directional_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "placement/triangle.h"
#include "random_tree.h"

namespace cairn::test::directional_gap_test {
namespace {

using bullet::DirectionalGap;
using bullet::GapPoint;
using bullet::GapWindow;
using bullet::Triangle;

constexpr unsigned kSeed = 31;
constexpr float kEverywhere = 10;
// Coordinates are below 2 and rounded by 2^-24 of that, a few dozen times, and slopes magnify by at most 4.
constexpr float kRounding = 2e-5F;

using Soup = std::vector<Triangle>;

struct Scene {
  Mat3 turn;  // from where surfaces are upper and lower along z to the frame of the question
  Soup upper, lower;
};

// A bumpy grid over the unit square; `facing` 1 looks up, -1 down.
Soup grid(std::mt19937_64& engine, float height, int facing, const Mat3& turn) {
  constexpr int kCells = 3;
  const float shift = float(uniform(engine, -0.3, 0.3)), spin = float(uniform(engine, 0, 6));
  std::vector<Vec3> points;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const float x = float(i) / kCells - 0.5F, y = float(j) / kCells - 0.5F;
      points.push_back({std::cos(spin) * x - std::sin(spin) * y + shift, std::sin(spin) * x + std::cos(spin) * y,
                        height + float(uniform(engine, -0.2, 0.2))});
    }
  Soup soup;
  const auto add = [&](int a, int b, int c) {
    if (facing < 0) std::swap(b, c);
    const auto at = [&](int k) { return turn * points[static_cast<std::size_t>(k)]; };
    soup.push_back({at(a), at(b), at(c)});
  };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const int k = i * (kCells + 1) + j, below = k + kCells + 1;
      add(k, below, below + 1);
      add(k, below + 1, k + 1);
    }
  return soup;
}

Scene randomScene(std::mt19937_64& engine) {
  const Mat3d turn = randomRotation(engine);
  Scene scene{{{Vec3(turn.rows[0]), Vec3(turn.rows[1]), Vec3(turn.rows[2])}}, {}, {}};
  scene.upper = grid(engine, float(uniform(engine, -0.1, 0.6)), -1, scene.turn);
  scene.lower = grid(engine, 0, 1, scene.turn);
  return scene;
}

GapWindow wideWindow(const Vec3& normal) {
  return bullet::windowOfBalls(normal, {}, kEverywhere, {}, kEverywhere, 0);
}

std::vector<GapPoint> ask(const GapWindow& window, const Soup& upper, const Soup& lower, float reach, float depth) {
  DirectionalGap gap;
  gap.begin(window);
  const bullet::WindowView view = bullet::viewThrough(window, {});
  for (const Triangle& t : upper) gap.addUpper({view * t.a, view * t.b, view * t.c});
  for (const Triangle& t : lower) gap.addLower({view * t.a, view * t.b, view * t.c});
  const auto found = gap.run(reach, depth);
  return {found.begin(), found.end()};
}

float deepest(const std::vector<GapPoint>& points) {
  float least = std::numeric_limits<float>::infinity();
  for (const GapPoint& p : points) least = std::min(least, p.gap);
  return least;
}

float distanceTo(const Soup& soup, const Vec3& p) {
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : soup) least = std::min(least, distance(p, nearestOnTriangle(t, p).point));
  return least;
}

// Height of the triangle over (x, y) in the unturned frame; nothing beside it.
std::optional<double> heightAt(const Triangle& turned, const Mat3& turn, double x, double y) {
  const Mat3 back = transpose(turn);
  const Vec3d a(back * turned.a), b(back * turned.b), c(back * turned.c);
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
  const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
  if (v < 0 || w < 0 || v + w > 1) return {};
  return a.z + v * (b.z - a.z) + w * (c.z - a.z);
}

std::optional<double> sampledGap(const Scene& scene, double x, double y) {
  std::optional<double> upper, lower;
  for (const Triangle& t : scene.upper)
    if (const auto h = heightAt(t, scene.turn, x, y)) upper = std::min(upper.value_or(*h), *h);
  for (const Triangle& t : scene.lower)
    if (const auto h = heightAt(t, scene.turn, x, y)) lower = std::max(lower.value_or(*h), *h);
  if (!upper || !lower) return {};
  return *upper - *lower;
}

// Nothing that brute force finds is deeper, and what is said to be the deepest lies on both surfaces.
TEST(DirectionalGap, IsTheLeastHeightOfOneSurfaceOverTheOther) {
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 60; ++trial) {
    const Scene scene = randomScene(engine);
    const Vec3 normal = scene.turn.column(2);
    const auto points = ask(wideWindow(normal), scene.upper, scene.lower, kEverywhere, 0);
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4000; ++i)
      if (const auto gap = sampledGap(scene, uniform(engine, -0.9, 0.9), uniform(engine, -0.9, 0.9)))
        sampled = std::min(sampled, *gap);
    ASSERT_FALSE(points.empty()) << "seed " << kSeed << ", trial " << trial;
    const float exact = deepest(points);
    EXPECT_LE(exact, sampled + kRounding) << "seed " << kSeed << ", trial " << trial;
    for (const GapPoint& p : points) {
      EXPECT_LT(distanceTo(scene.upper, p.position + normal * (0.5F * p.gap)), kRounding) << "trial " << trial;
      EXPECT_LT(distanceTo(scene.lower, p.position - normal * (0.5F * p.gap)), kRounding) << "trial " << trial;
    }
  }
}

// Moved by as much, they just touch: the same question then says zero.
TEST(DirectionalGap, IsHowFarTheUpperSurfaceCanMove) {
  std::mt19937_64 engine(kSeed + 1);
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene = randomScene(engine);
    const Vec3 normal = scene.turn.column(2);
    const float gap = deepest(ask(wideWindow(normal), scene.upper, scene.lower, kEverywhere, 0));
    for (Triangle& t : scene.upper)
      for (Vec3* corner : {&t.a, &t.b, &t.c}) *corner -= normal * gap;
    EXPECT_NEAR(deepest(ask(wideWindow(normal), scene.upper, scene.lower, kEverywhere, 0)), 0, kRounding) << trial;
  }
}

TEST(DirectionalGap, KeepsWhatIsAsDeepAndDropsTheRest) {
  std::mt19937_64 engine(kSeed + 2);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene = randomScene(engine);
    const GapWindow window = wideWindow(scene.turn.column(2));
    const auto all = ask(window, scene.upper, scene.lower, kEverywhere, kEverywhere);
    const auto few = ask(window, scene.upper, scene.lower, kEverywhere, 0.05F);
    EXPECT_EQ(deepest(all), deepest(few));
    const auto count =
        std::count_if(all.begin(), all.end(), [&](const GapPoint& p) { return p.gap <= deepest(all) + 0.05F; });
    EXPECT_EQ(std::ssize(few), count) << trial;
    EXPECT_LT(few.size(), all.size());
  }
}

// A tip that stands exactly over an edge or a corner that triangles share is over one of them.
TEST(DirectionalGap, SeesTipsOverSeams) {
  std::mt19937_64 engine(kSeed + 3);
  for (int trial = 0; trial < 200; ++trial) {
    const Mat3d turn = randomRotation(engine);
    const auto at = [&](double x, double y, double z) { return Vec3(turn * Vec3d(x, y, z)); };
    const Soup lower = {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0)},
                        {at(0, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                        {at(0, 0, 0), at(-1, 1, 0), at(-1, 0, 0)},
                        {at(0, 0, 0), at(0, 1, 0), at(-1, 1, 0)}};
    const double along = trial % 3 == 0 ? 0 : uniform(engine, 0.1, 0.9);
    const double x = trial % 2 ? along : 0, y = along;
    const Soup upper = {{at(x, y, 0.25), at(x + 0.1, y + 0.3, 0.9), at(x + 0.3, y + 0.1, 0.9)}};
    const auto points = ask(wideWindow(Vec3(turn * Vec3d(0, 0, 1))), upper, lower, 0.5F, 0);
    ASSERT_FALSE(points.empty()) << "seed " << kSeed + 3 << ", trial " << trial;
    EXPECT_NEAR(deepest(points), 0.25F, kRounding);
  }
}

TEST(DirectionalGap, LooksOnlyAtWhatFacesAndIsInTheWindow) {
  const Soup up = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, down = {{{0, 0, 0.1F}, {0, 1, 0.1F}, {1, 0, 0.1F}}};
  const Soup upAbove = {{{0, 0, 0.1F}, {1, 0, 0.1F}, {0, 1, 0.1F}}};
  const Soup wall = {{{0.2F, 0.1F, 0.1F}, {0.2F, 0.3F, 0.1F}, {0.2F, 0.2F, 0.4F}}};
  const GapWindow window = wideWindow({0, 0, 1});
  EXPECT_NEAR(deepest(ask(window, down, up, 1, 0)), 0.1F, 1e-6F);
  EXPECT_TRUE(ask(window, upAbove, up, 1, 0).empty()) << "seen from behind";
  EXPECT_TRUE(ask(window, down, down, 1, 0).empty());
  EXPECT_TRUE(ask(window, wall, up, 1, 0).empty()) << "seen edge-on";
  EXPECT_TRUE(ask(window, down, up, 0.05F, 0).empty()) << "beyond the reach";
  EXPECT_TRUE(ask(bullet::windowOfBalls({0, 0, 1}, {5, 0, 0}, 1, {5, 0, 0}, 1, 0), down, up, 1, 0).empty());
  EXPECT_TRUE(ask(bullet::windowOfBalls({0, 0, 1}, {0, 0, 3}, 1, {0, 0, 0}, 1, 0), down, up, 1, 0).empty())
      << "too low for the upper ball";
  EXPECT_TRUE(bullet::windowOfBalls({0, 0, 1}, {5, 0, 0}, 1, {0, 0, 0}, 1, 0).isEmpty());
  const GapWindow small = bullet::windowOfBalls({0, 0, 1}, {0.3F, 0.3F, 0.1F}, 0.1F, {0.3F, 0.3F, 0}, 0.1F, 0);
  for (const GapPoint& p : ask(small, down, up, 1, 1)) {
    EXPECT_NEAR(p.position.x, 0.3F, 0.1F + 1e-6F);
    EXPECT_NEAR(p.position.y, 0.3F, 0.1F + 1e-6F);
  }
}

}  // namespace
}  // namespace cairn::test::directional_gap_test

// SPDX-License-Identifier: GPL-3.0-or-later
// The overlap of two faces, against points strewn over them.
#include "continuous/face_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace cairn::bullet {
namespace {

constexpr std::uint32_t kSeed = 20051;
// Rounding, and the seam of a thousandth of the first face's size.
constexpr float kTolerance = 4e-3F;
const Vec3 kUp(0, 0, 1);

// Of a regular face, in order, at a height of its own.
std::vector<Vec3> face(int corners, float radius, float turn, const Vec3& middle) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const float angle = turn + 2 * 3.14159265F * float(i) / float(corners);
    points.push_back(middle + Vec3(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  return points;
}

// How far a point lies inside all sides of a face that goes around upwards, negative outside.
float inside(const std::vector<Vec3>& face, const Vec3& point) {
  float least = INFINITY;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 side = normalized(cross(kUp, face[(i + 1) % face.size()] - face[i]));
    least = std::min(least, dot(side, point - face[i]));
  }
  return least;
}

TEST(FaceOverlap, LiesInBothFacesWhereverTheyOverlap) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(0, 1);
  int overlaps = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto any = [&] {
      return face(3 + int(6 * unit(random)), 0.3F + unit(random), 6 * unit(random),
                  Vec3(2 * unit(random), 2 * unit(random), unit(random)));
    };
    const std::vector<Vec3> first = any(), second = any();
    float deepest = -INFINITY;
    for (int i = 0; i < 400; ++i) {
      const Vec3 point = second[0] + Vec3(4 * unit(random) - 2, 4 * unit(random) - 2, 0);
      deepest = std::max(deepest, std::min(inside(first, point), inside(second, point)));
    }
    FaceOverlap place;
    place.find(kUp, first, second);
    ASSERT_FALSE(place.points().empty());
    for (const Vec3& p : place.points()) {
      EXPECT_NEAR(p.z, second[0].z, 1e-5F) << "seed " << kSeed << ", trial " << trial;
      EXPECT_GT(inside(second, p), -kTolerance) << "seed " << kSeed << ", trial " << trial;
      if (deepest > 0) EXPECT_GT(inside(first, p), -kTolerance) << "seed " << kSeed << ", trial " << trial;
    }
    overlaps += deepest > 0 ? 1 : 0;
  }
  EXPECT_GT(overlaps, 500);
}

TEST(FaceOverlap, OfEdgesIsWhereTheyCross) {
  const std::vector<Vec3> first{{-1, 0, 0}, {1, 0, 0}}, second{{0.25F, -1, 0.1F}, {0.25F, 2, 0.1F}};
  FaceOverlap place;
  place.find(kUp, first, second);
  for (const Vec3& p : place.points()) {
    EXPECT_NEAR(p.x, 0.25F, kTolerance);
    EXPECT_NEAR(p.y, 0, kTolerance);
  }
}

TEST(FaceOverlap, OfAnEdgeOnAFaceHasBothItsEnds) {
  FaceOverlap place;
  place.find(kUp, face(4, 2, 0, Vec3()), std::vector<Vec3>{{-0.5F, 0, 0}, {0.5F, 0, 0}});
  float least = 1, greatest = -1;
  for (const Vec3& p : place.points()) {
    least = std::min(least, p.x);
    greatest = std::max(greatest, p.x);
  }
  EXPECT_FLOAT_EQ(least, -0.5F);
  EXPECT_FLOAT_EQ(greatest, 0.5F);
}

TEST(FaceOverlap, BesideEachOtherIsTheSecondsNearestPoint) {
  FaceOverlap place;
  place.find(kUp, face(4, 1, 0, Vec3(5, 0, 0)), std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  ASSERT_EQ(place.points().size(), 1U);
  EXPECT_NEAR(distance(place.points()[0], Vec3(1, 0, 0)), 0, 1e-5F);
  place.find(kUp, std::vector<Vec3>{{5, 0, 0}}, std::vector<Vec3>{{-1, 0, 0}});
  EXPECT_EQ(place.points()[0].x, -1);
}

}  // namespace
}  // namespace cairn::bullet

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mass properties of unions of balls, and the texts grains are written as.
#include "cairn/builder/grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>

#include "builder_meshes.h"
#include "run_program.h"

namespace cairn::builder::grain_test {
namespace {

using std::numbers::pi;

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) / 9007199254740992.0;
}

std::vector<Ball> randomBalls(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::vector<Ball> balls;
  while (balls.size() < count)
    balls.push_back({{uniform(random), uniform(random), uniform(random)}, 0.1 + 0.4 * uniform(random), 0});
  return balls;
}

/// The union by lines along z: the middle of each cell of a grid, intervals in closed form.
struct LineSum {
  double volume = 0;
  Vec3d first;
  double xx = 0, yz = 0;
};

void addInterval(LineSum& sum, double x, double y, double from, double to, double area) {
  const double length = (to - from) * area, z = (from + to) / 2;
  sum.volume += length;
  sum.first += Vec3d{x, y, z} * length;
  sum.xx += x * x * length;
  sum.yz += y * z * length;
}

LineSum byLines(const std::vector<Ball>& balls, int cells) {
  LineSum sum;
  const double lower = -1, edge = 3.0 / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double x = lower + (i + 0.5) * edge, y = lower + (j + 0.5) * edge;
      std::vector<std::pair<double, double>> parts;
      for (const Ball& b : balls) {
        const double h2 = b.radius * b.radius - std::pow(x - b.center.x, 2) - std::pow(y - b.center.y, 2);
        if (h2 > 0) parts.emplace_back(b.center.z - std::sqrt(h2), b.center.z + std::sqrt(h2));
      }
      std::sort(parts.begin(), parts.end());
      for (std::size_t k = 0; k < parts.size();) {
        double end = parts[k].second;
        std::size_t n = k + 1;
        for (; n < parts.size() && parts[n].first <= end; ++n) end = std::max(end, parts[n].second);
        addInterval(sum, x, y, parts[k].first, end, edge * edge);
        k = n;
      }
    }
  return sum;
}

double secondMoment(const MassProperties& mass, int a, int b) {
  const Mat3d& i = mass.inertia;
  const double trace = (i(0, 0) + i(1, 1) + i(2, 2)) / 2;
  const double about = (a == b ? trace : 0) - i(a, b);
  return mass.volume * (about + mass.centerOfMass[a] * mass.centerOfMass[b]);
}

TEST(UnionMass, OfOneBallIsABalls) {
  const MassProperties mass = massOf(std::vector{Ball{{3, -2, 5}, 2, 0}});
  EXPECT_NEAR(mass.volume, 4 * pi / 3 * 8, 1e-12);
  EXPECT_EQ(mass.centerOfMass, Vec3d(3, -2, 5));
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(mass.inertia(a, b), a == b ? 0.4 * 4 : 0, 1e-12);
}

TEST(UnionMass, OfTwoBallsLacksTheLens) {
  for (const double d : {0.2, 0.9, 1.3, 1.7, 1.999}) {
    const double R = 1.2, r = 0.8;
    const MassProperties mass = massOf(std::vector{Ball{{0, 0, 0}, R, 0}, Ball{{d, 0, 0}, r, 0}});
    const double lens =
        d <= R - r ? 4 * pi / 3 * r * r * r
                   : pi * std::pow(R + r - d, 2) * (d * d + 2 * d * (R + r) - 3 * std::pow(R - r, 2)) / (12 * d);
    EXPECT_NEAR(mass.volume, 4 * pi / 3 * (R * R * R + r * r * r) - lens, 1e-12) << d;
  }
}

TEST(UnionMass, AgreesWithLines) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Ball> balls = randomBalls(seed, 1 + 3 * seed);
    const MassProperties mass = massOf(balls);
    const LineSum lines = byLines(balls, 300);
    // The middle rule's error falls with the power 1.5 of the cell at rims: 6e-4 is some five times what is seen.
    EXPECT_NEAR(mass.volume / lines.volume, 1, 6e-4);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(mass.centerOfMass[a], lines.first[a] / lines.volume, 6e-4);
    EXPECT_NEAR(secondMoment(mass, 0, 0), lines.xx, 1e-3 * lines.volume);
    EXPECT_NEAR(secondMoment(mass, 1, 2), lines.yz, 1e-3 * lines.volume);
  }
}

TEST(UnionMass, IsTheSameTurnedMovedAndScaled) {
  const Mat3d turn{{Vec3d{0.36, 0.48, -0.8}, Vec3d{-0.8, 0.6, 0}, Vec3d{0.48, 0.64, 0.6}}};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::vector<Ball> balls = randomBalls(seed, 25);
    const MassProperties mass = massOf(balls);
    for (Ball& ball : balls) ball = {turn * ball.center * 10 + Vec3d{70, -40, 5}, ball.radius * 10, 0};
    const MassProperties turned = massOf(balls);
    EXPECT_NEAR(turned.volume / mass.volume, 1000, 1e-8);
    EXPECT_LE(distance(turned.centerOfMass, turn * mass.centerOfMass * 10 + Vec3d{70, -40, 5}), 1e-9);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(turned.principalMoments[a] / mass.principalMoments[a], 100, 1e-7);
  }
}

TEST(UnionMass, CountsDuplicatesAndHeldBallsOnce) {
  std::vector<Ball> balls = randomBalls(3, 6);
  const double volume = massOf(balls).volume;
  balls.push_back(balls[2]);
  balls.push_back({balls[4].center, balls[4].radius / 2, 0});
  balls.push_back({balls[1].center + Vec3d{0.01, 0, 0}, balls[1].radius - 0.01, 0});  // touches from inside
  EXPECT_NEAR(massOf(balls).volume, volume, 1e-12);
}

TEST(UnionMass, OfBallsThroughOneCircleKnowsOnePlane) {
  // Three balls on one line through the same circle: the middle one's cell ends at the same plane towards both.
  const auto through = [](double x) { return Ball{{x, 0, 0}, std::sqrt(1 + x * x), 0}; };
  const MassProperties two = massOf(std::vector{through(-1), through(1)});
  const MassProperties three = massOf(std::vector{through(-1), through(0), through(1)});
  const MassProperties other = massOf(std::vector{through(0), through(1), through(-1)});
  EXPECT_NEAR(three.volume, two.volume, 1e-12);  // the middle ball lies in the two
  EXPECT_NEAR(other.volume, two.volume, 1e-12);
}

/// The lines of a text, each as numbers; fails for anything else between separators.
std::vector<std::vector<double>> strictRows(const std::string& text, char separator, std::size_t columns) {
  std::vector<std::vector<double>> rows;
  EXPECT_TRUE(text.ends_with('\n'));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<double> row;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, separator);) {
      std::size_t used = 0;
      row.push_back(std::stod(word, &used));
      EXPECT_EQ(used, word.size()) << line;
    }
    EXPECT_EQ(row.size(), columns) << line;
    rows.push_back(row);
  }
  return rows;
}

struct GrainCase {
  TriangleMesh mesh = test::moved(test::lumpyBall(2, 4), [](const Vec3d& v) { return v * 0.3 + Vec3d{5, 6, -7}; });
  std::vector<Ball> balls{{{5, 6, -7}, 0.31, 0}, {{5.1, 6, -7.05}, 0.2, 0}, {{4.8, 6.1, -7}, 0.125, 0}};
  Grain grain{balls, massOf(mesh)};
};

void expectCentred(const std::vector<std::vector<double>>& rows, const GrainCase& c) {
  ASSERT_EQ(rows.size(), c.balls.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3d p{rows[i][0], rows[i][1], rows[i][2]};
    EXPECT_LE(distance(p + c.grain.mass.centerOfMass, c.balls[i].center), 1e-12);
    EXPECT_EQ(rows[i][3], c.balls[i].radius);
  }
}

TEST(GrainTexts, LiggghtsIsFourNumbersALineAboutTheCentreOfMass) {
  const GrainCase c;
  expectCentred(strictRows(liggghtsText(c.grain), ' ', 4), c);
}

TEST(GrainTexts, YadeIsAClumpOfOneId) {
  const GrainCase c;
  const std::string text = yadeText(c.grain), head = "#format x_y_z_r_clumpId\n";
  ASSERT_EQ(text.rfind(head, 0), 0U);
  const auto rows = strictRows(text.substr(head.size()), ' ', 5);
  expectCentred(rows, c);
  for (const auto& row : rows) EXPECT_EQ(row[4], 0);
}

TEST(GrainTexts, ChronoIsInPrincipalAxes) {
  const GrainCase c;
  const std::string text = chronoText(c.grain), head = "x,y,z,r\n";
  ASSERT_EQ(text.rfind(head, 0), 0U);
  auto rows = strictRows(text.substr(head.size()), ',', 4);
  for (auto& row : rows) {
    const Vec3d p = c.grain.mass.principalAxes * Vec3d{row[0], row[1], row[2]};
    row[0] = p.x, row[1] = p.y, row[2] = p.z;
  }
  expectCentred(rows, c);
}

TEST(GrainTexts, ClumpKeepsTheMeshsFrame) {
  const GrainCase c;
  const auto rows = strictRows(clumpText(c.grain), ',', 4);
  ASSERT_EQ(rows.size(), c.balls.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(Vec3d(rows[i][0], rows[i][1], rows[i][2]), c.balls[i].center);
    EXPECT_EQ(rows[i][3], c.balls[i].radius);
  }
}

TEST(ReadCover, TakesSpheresAndRefusesTheRestByItsLine) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "cover.txt").string();
  test::writeText(file, "# made by hand\n1 2 3 0.5 0.1 0.2\n\n-1e-3 2 3 4\n");
  const auto balls = readCover(file);
  ASSERT_TRUE(balls.ok()) << balls.error().message;
  ASSERT_EQ(balls.value().size(), 2U);
  EXPECT_EQ(balls.value()[1].center, Vec3d(-1e-3, 2, 3));
  EXPECT_EQ(balls.value()[1].radius, 4);
  for (const auto& [text, part] :
       {std::pair{"1 2 3 4\n1 2 3\n", "line 2"}, std::pair{"1 2 3 0\n", "radius 0"},
        std::pair{"1 2 3 -4\n", "radius -4"}, std::pair{"1 2 x 4\n", "'x'"}, std::pair{"1 2 nan 4\n", "nan"},
        std::pair{"1 2 inf 4\n", "inf"}, std::pair{"1 2 1e300 4\n", "1e300"}, std::pair{"", "no sphere"},
        std::pair{"1,2,3,4\n", "line 1"}}) {
    test::writeText(file, text);
    const auto refused = readCover(file);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  }
  EXPECT_FALSE(readCover((folder.path() / "nowhere").string()).ok());
}

}  // namespace
}  // namespace cairn::builder::grain_test

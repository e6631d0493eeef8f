// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "collider_trials.h"
#include "compare.h"
#include "dynamics_cases.h"
#include "random_tree.h"
#include "scenes/figures/random.h"
#include "triangle_grounds.h"

// A flat plane of triangles is a plane: a block slides over its seams, a ball rolls, as if there were none.
//
//    ___________
//   |\  |\  |\  |     coarse, fine, turned about, fans, at random
//   |_\_|_\_|_\_|  ->
//   |\  |\  |\  |
namespace cairn::hard {
namespace {

using Corners = std::vector<btVector3>;

void addCell(Corners& out, const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& d, bool other) {
  if (other)
    out.insert(out.end(), {a, b, d, b, c, d});
  else
    out.insert(out.end(), {a, b, c, a, c, d});
}

// Cells of a square of 16 m; `place` moves inner grid points.
Corners grid(int cells, const std::function<bool(int, int)>& isOther,
             const std::function<btVector3(int, int)>& moved = {}) {
  const double cell = 16.0 / cells;
  const auto at = [&](int i, int j) {
    btVector3 p(btScalar(i * cell - 8), btScalar(j * cell - 8), 0);
    if (moved && i > 0 && j > 0 && i < cells && j < cells) p += moved(i, j) * btScalar(cell);
    return p;
  };
  Corners out;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) addCell(out, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), isOther(i, j));
  return out;
}

// All from one point beside the way: slivers.
Corners fan() {
  const btVector3 from(btScalar(0.37), btScalar(-0.23), 0);
  Corners rim, out;
  constexpr int kParts = 40;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kParts; ++i) {
      const btScalar t = btScalar(16.0 * i / kParts - 8);
      const btVector3 p[4] = {{t, -8, 0}, {8, t, 0}, {-t, 8, 0}, {-8, -t, 0}};
      rim.push_back(p[side]);
    }
  for (std::size_t i = 0; i < rim.size(); ++i) out.insert(out.end(), {from, rim[i], rim[(i + 1) % rim.size()]});
  return out;
}

std::vector<test::TriedGround> grounds() {
  constexpr btScalar kMargin = btScalar(0.001);
  std::mt19937_64 engine(5);
  const auto same = [](int, int) { return false; };
  const auto random = [&](int, int) {
    const Vec3d p = test::randomPoint(engine);
    return btVector3(btScalar(0.35 * p.x), btScalar(0.35 * p.y), 0);
  };
  // Moves are asked for several times a point: they are fixed first.
  std::vector<btVector3> moves;
  for (int i = 0; i < 17 * 17; ++i) moves.push_back(random(0, 0));
  const Corners all[] = {grid(4, same), grid(64, same), grid(16, [](int i, int j) { return (i + j) % 2 == 0; }), fan(),
                         grid(16, same, [&](int i, int j) { return moves[std::size_t(i * 17 + j)]; })};
  const char* const names[] = {"coarse", "fine", "alternating", "fan", "random"};
  std::vector<test::TriedGround> made;
  for (std::size_t i = 0; i < 5; ++i) {
    auto shape = test::meshOf(all[i]);
    shape->setMargin(kMargin);
    made.push_back({names[i], shape, kMargin, kMargin});
  }
  return made;
}

// The worst of all grounds, against the same body on a plane: acceleration, way aside, how far ways aside on these
// grounds are apart, hop. Trees touch the triangles themselves, Bullet's shapes their margin.
struct Worst {
  double slower = 0, aside = 0, apart = 0, hop = 0;
};

Worst worstOn(const std::vector<test::TriedGround>& grounds, const test::TriedMover& mover, bool rolls) {
  const test::TriedGround plane{"plane", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), 0};
  const auto runOn = [&](const test::TriedGround& ground) {
    return rolls ? test::Trials::roll(ground, mover, false) : test::Trials::slide(ground, mover, false);
  };
  const test::SlopeRun level = runOn(plane);
  Worst worst;
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const test::TriedGround& ground : grounds) {
    const test::SlopeRun run = runOn(ground);
    worst.slower = test::greatest(worst.slower, 100 * std::abs(run.acceleration / level.acceleration - 1));
    worst.aside = test::greatest(worst.aside, std::abs(run.aside - level.aside));
    least = -test::greatest(-least, -run.aside);
    most = test::greatest(most, run.aside);
    const test::Slope slope = test::Trials::slopeOf(ground, mover, rolls ? 10 : 30, rolls ? 1 : 0.3, false);
    test::SlopeScene scene(mover.body, slope);
    double lowest = 1, highest = -1;
    scene.step(slope.fromStep);
    for (int i = slope.fromStep; i < slope.toStep; ++i) {
      scene.step(1);
      const double height = scene.along(scene.way(), 2);
      lowest = -test::greatest(-lowest, -height);
      highest = test::greatest(highest, height);
    }
    worst.hop = test::greatest(worst.hop, highest - lowest);
  }
  worst.apart = most - least;
  return worst;
}

/// Of a ball that starts as it may: how its facets happen to lie decides as much as the seams.
Worst worstOfStarts(const std::vector<test::TriedGround>& grounds, const test::TriedMover& ball, int starts) {
  Worst worst;
  for (int start = 0; start < starts; ++start) {
    test::TriedMover turned = ball;
    turned.turned = scenes::Random(1, std::uint64_t(start)).rotation();
    const Worst one = worstOn(grounds, turned, true);
    worst = {test::greatest(worst.slower, one.slower), test::greatest(worst.aside, one.aside),
             test::greatest(worst.apart, one.apart), test::greatest(worst.hop, one.hop)};
  }
  return worst;
}

Outcome runFlatMeshes(Effort effort) {
  const int starts = effort == Effort::quick ? 2 : 12;
  const std::vector<test::TriedGround> all = grounds();
  const CaseBodies &block = boxes({test::kBlock[0], test::kBlock[1], test::kBlock[2]}), &ball = balls(test::kRoller);
  const double blockSize = std::sqrt(1 + 0.16 + 0.09), ballSize = 2 * test::kRoller * std::sqrt(3.0);
  const std::vector<Asked> asked{{"slide, off the plane's acceleration", 2, Bound::atMost, "%"},
                                 {"slide, aside of the way on the plane", 1, Bound::atMost, "% of size"},
                                 {"slide, aside, the five from each other", 1, Bound::atMost, "% of size"},
                                 {"slide, hop", 0.5, Bound::atMost, "% of size"},
                                 {"roll, off the plane's acceleration", 2, Bound::atMost, "%"},
                                 {"roll, aside of the way on the plane", 1, Bound::atMost, "% of size"},
                                 {"roll, aside, the five from each other", 1, Bound::atMost, "% of size"},
                                 {"roll, hop", 0.5, Bound::atMost, "% of size"}};
  std::vector<Figures> figures;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Worst slide = worstOn(all, test::blockMover("", block[i].body.shape, block[i].body.margin), false);
    const Worst roll = worstOfStarts(all, test::ballMover("", ball[i].body.shape, ball[i].body.margin), starts);
    figures.push_back({slide.slower, 100 * slide.aside / blockSize, 100 * slide.apart / blockSize,
                       100 * slide.hop / blockSize, roll.slower, 100 * roll.aside / ballSize,
                       100 * roll.apart / ballSize, 100 * roll.hop / ballSize});
  }
  return {
      besideTheBest(asked, figures[0], {{"box, sphere", figures[1]}, {"hull", figures[2]}, {"gimpact", figures[3]}}),
      "The ball's own facets carry it aside, on a plane as on a mesh: much the same over every triangulation, and less "
      "than a hull or GImpact. Bullet's sphere has no facets."};
}

}  // namespace

HardCase flatMeshes() {
  return {
      "D10", "over the seams of a flat mesh",
      "a block slides, a ball rolls (the worst of twelve starts) on five triangulations of a plane at 60 Hz: within "
      "2 % of what the same body does on a plane from the same start, aside of its way there, and of its ways on "
      "the others, by at most 0.01, hopping by at most 0.005 of its size (proposed list)",
      runFlatMeshes};
}

}  // namespace cairn::hard

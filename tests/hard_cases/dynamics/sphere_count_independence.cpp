// SPDX-License-Identifier: GPL-3.0-or-later
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "bodies.h"
#include "collider_shapes.h"
#include "compare.h"
#include "dynamics_cases.h"
#include "gimpact_mesh.h"
#include "scenes/figures/random.h"
#include "textbook.h"

// One box, one ball, each with 8, 64 and 512 leaves: what they do must not tell how many.
//
//      |                     _                  __
//     _v_                  .' '--._           .'  '.
//    |___|  bounces       |_      ^'.  slides (    ) '-._  rolls
//   =======  e = v'/v        '-._    '-.       '--'-._    '-.
namespace cairn::hard {
namespace {

using test::textbook::Bench;

constexpr double kRestitution = 0.5, kFriction = 0.3;
constexpr btScalar kSlide = btScalar(30);
// Degrees.
constexpr std::array<btScalar, 5> kRolls{3, 5, 8, 12, 20};
constexpr btScalar kRoll = 10;
// Those on which no facet holds what lies on it: their corners are up to 5.1 degrees off their normals.
constexpr std::array<btScalar, 4> kFreeRolls{8, 10, 12, 20};

struct Shapes {
  std::shared_ptr<btCollisionShape> box, ball;
  btScalar margin = 0;
};

void allowGimpact(Bench& bench) {
  btGImpactCollisionAlgorithm::registerAlgorithm(&bench.world.bullet.dispatcher);
}

// Dropped flat from a metre: the speed after the blow over that before it.
double restitutionOf(const Shapes& shapes) {
  Bench bench(0, btScalar(0.5), btScalar(kRestitution));
  allowGimpact(bench);
  const btVector3& size = test::textbook::kSlab;
  btRigidBody& slab = bench.put(shapes.box, test::textbook::boxInertia(size), size.z() / 2 + shapes.margin + 1);
  double before = 0, after = 0;
  for (int i = 0; i < 240 && after <= 0; ++i) {
    before = -double(slab.getLinearVelocity().z());
    bench.world.runStep();
    after = double(slab.getLinearVelocity().z());
  }
  return after / before;
}

// The friction that follows from the acceleration down a slope.
double frictionOf(const Shapes& shapes) {
  const btScalar angle = kSlide * SIMD_RADS_PER_DEG;
  Bench bench(angle, btScalar(kFriction));
  allowGimpact(bench);
  const btVector3& size = test::textbook::kSlab;
  btRigidBody& slab = bench.put(shapes.box, test::textbook::boxInertia(size), size.z() / 2 + shapes.margin);
  bench.run(0.25);
  const double before = bench.speedOf(slab);
  bench.run(1);
  const double a = bench.speedOf(slab) - before;
  return (std::sin(double(angle)) - a / test::textbook::g) / std::cos(double(angle));
}

double rollingOf(const Shapes& shapes, btScalar degrees, const btQuaternion& turned = btQuaternion::getIdentity()) {
  Bench bench(degrees * SIMD_RADS_PER_DEG, btScalar(0.8));
  allowGimpact(bench);
  btRigidBody& ball = bench.put(shapes.ball, test::textbook::ballInertia(), test::textbook::kRadius + shapes.margin);
  ball.setWorldTransform(ball.getWorldTransform() * btTransform(turned));
  bench.run(0.25);
  const double before = bench.speedOf(ball);
  bench.run(1);
  return bench.speedOf(ball) - before;
}

// Greatest over least, less 1.
double spread(std::span<const Shapes> all, const std::function<double(const Shapes&)>& figure) {
  double least = std::numeric_limits<double>::max(), greatest = -least;
  for (const Shapes& shapes : all) {
    const double value = figure(shapes);
    if (!std::isfinite(value) || value <= 0) return std::numeric_limits<double>::quiet_NaN();
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  return 100 * (greatest / least - 1);
}

double rollingSpread(std::span<const Shapes> all, btScalar degrees) {
  return spread(all, [&](const Shapes& shapes) { return rollingOf(shapes, degrees); });
}

// From one start it is chance on which facets a ball is when it is asked.
double meanRollingSpread(std::span<const Shapes> all, btScalar degrees) {
  constexpr std::uint64_t kStarts = 16;
  return spread(all, [&](const Shapes& shapes) {
    double sum = 0;
    for (std::uint64_t i = 0; i < kStarts; ++i) sum += rollingOf(shapes, degrees, scenes::Random(1, i).rotation());
    return sum / double(kStarts);
  });
}

double worstOn(std::span<const btScalar> slopes, std::span<const Shapes> all,
               double (*spreadOn)(std::span<const Shapes>, btScalar)) {
  std::vector<double> spreads;
  for (const btScalar degrees : slopes) spreads.push_back(spreadOn(all, degrees));
  return quantileOf(spreads, 1, Bound::atMost);
}

// The shapes from few parts to many.
Figures spreads(std::span<const Shapes> all) {
  return {spread(all, restitutionOf),
          spread(all, frictionOf),
          rollingSpread(all, kRoll),
          worstOn(kRolls, all, rollingSpread),
          worstOn(kFreeRolls, all, meanRollingSpread),
          worstOn(kFreeRolls, all.subspan(1), meanRollingSpread)};
}

test::Solid slab(int cells) {
  const btVector3& s = test::textbook::kSlab;
  return test::cuboid({double(s.x()), double(s.y()), double(s.z())}, cells);
}
test::Solid ball() {
  return test::ball(double(test::textbook::kRadius), 16);
}

std::vector<Shapes> trees() {
  std::vector<Shapes> all;
  for (std::uint32_t depth = 1; depth <= 3; ++depth) all.push_back({treeOf(slab(2), depth), treeOf(ball(), depth)});
  return all;
}

// The same box and the same facets of ever more triangles.
std::vector<Shapes> gimpacts() {
  constexpr btScalar kMargin = btScalar(0.001);
  std::vector<Shapes> all;
  test::Solid facets = ball();
  for (const int cells : {1, 2, 4}) {
    all.push_back({test::gimpactMesh(slab(cells), kMargin), test::gimpactMesh(facets, kMargin), kMargin});
    facets = test::quartered(facets);
  }
  return all;
}

// The box of 8, 64 and 512 boxes.
std::vector<Shapes> compounds() {
  std::vector<Shapes> all;
  for (const int cells : {2, 4, 8}) {
    const btVector3 part = test::textbook::kSlab / btScalar(cells), first = (part - test::textbook::kSlab) / 2;
    const auto tile = std::make_shared<btBoxShape>(part / 2);
    std::vector<std::pair<btVector3, std::shared_ptr<btCollisionShape>>> children;
    for (int i = 0; i < cells * cells * cells; ++i)
      children.push_back(
          {first + part * btVector3(btScalar(i % cells), btScalar(i / cells % cells), btScalar(i / cells / cells)),
           tile});
    all.push_back({test::detail::compoundOf(children), std::make_shared<btSphereShape>(test::textbook::kRadius)});
  }
  return all;
}

Outcome runSphereCountIndependence(Effort) {
  const std::vector<Asked> asked{{"restitution, spread", 2, Bound::atMost, "%"},
                                 {"friction, spread", 2, Bound::atMost, "%"},
                                 {"rolling acceleration at 10 degrees, spread", 2, Bound::atMost, "%"},
                                 {"rolling acceleration at 3 to 20 degrees, spread", 2, Bound::atMost, "%"},
                                 {"mean of 16 starts at 8 to 20 degrees, spread", 2, Bound::atMost, "%"},
                                 {"the same of 64 and 512 leaves alone", 2, Bound::atMost, "%"}};
  const Figures boxes = spreads(gimpacts()), parts = spreads(compounds());
  std::vector<StockRun> stock{{"gimpact", boxes}, {"compound", parts}};
  // The ball beside the boxes of a compound is one shape whatever their number: nothing to compare.
  std::fill(stock.back().figures.begin() + 2, stock.back().figures.end(), std::numeric_limits<double>::quiet_NaN());
  return {
      besideTheBest(asked, spreads(trees()), stock),
      "Balls roll over facets, and trees of other leaves ask about other points of the same ones; from one start it "
      "is chance which of them are asked."};
}

}  // namespace

HardCase sphereCountIndependence() {
  return {
      "D15", "the number of spheres does not show",
      "one box and one ball of 8, 64 and 512 leaves: restitution, friction and rolling acceleration, on six slopes and "
      "from several starts, within 2 % of each other (proposed list)",
      runSphereCountIndependence};
}

}  // namespace cairn::hard

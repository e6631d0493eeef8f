// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bodies.h"
#include "compare.h"
#include "dynamics_cases.h"
#include "exact_pile.h"
#include "pile.h"

// Rocks, and a few slabs, fall into a pit on next to nothing: from no operation a step to a third of the ten thousand
// that twenty rocks need.
//
//    |  o O |      what there is an answer for is re-tested, what waits is held
//    | O o  |      budget ->   0    1    10   100  300  1000  3000 .. all
//    |OoOoOo|      error  ->   large ............................ that of the leaves
//    '------'
namespace cairn::hard {
namespace {

constexpr double kSize = 1, kDeep = 0.01;  // deep: parts of the size
using Operations = std::optional<std::int64_t>;

int numberOf(const Pile& pile, const btCollisionObject* object) {
  const auto at = std::ranges::find(pile.bodies(), object);
  if (at != pile.bodies().end()) return int(at - pile.bodies().begin());
  return -1 - int(std::ranges::find(pile.planes(), object) - pile.planes().begin());
}

bool hasContact(Pile& pile, const MeetingPair& wanted) {
  test::StillWorld& world = pile.world();
  for (int i = 0; i < world.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *world.dispatcher.getManifoldByIndexInternal(i);
    const int a = numberOf(pile, manifold.getBody0()), b = numberOf(pile, manifold.getBody1());
    if (manifold.getNumContacts() > 0 && wanted.isSamePair(a, b)) return true;
  }
  return false;
}

struct Fall {
  double insane = 0, lost = 0;
  double rise = 0;    // greatest gain of energy after any loss, part of that at the start
  double missed = 0;  // steps in which the deepest pair, if deep, had no contact
  double wait = 0;    // the most of those in a row
  double unheld = 0;  // how deep it was at most in those
  double depth = 0;   // deepest of all steps
  double lying = 0;   // deepest of their last third, in which they lie
};

Fall fall(const test::TriedBody& tried, const ExactPile& judge, const PileOptions& options, int steps,
          const Operations& operations) {
  Pile pile(tried, kSize, options);
  if (operations && !pile.world().dispatcher.setBudget({*operations, {}}).ok()) return {.insane = NAN};
  const double start = pile.energy();
  double least = start;
  Fall result;
  int waiting = 0;
  for (int i = 0; i < steps; ++i) {
    const MeetingPair deepest = judge.deepest(pile);
    pile.step();
    result.depth = std::max(result.depth, deepest.depth);
    if (3 * i >= 2 * steps) result.lying = std::max(result.lying, deepest.depth);
    const bool isMissed = deepest.depth > kDeep * kSize && !hasContact(pile, deepest);
    waiting = isMissed ? waiting + 1 : 0;
    result.missed += isMissed ? 1 : 0;
    if (isMissed) result.unheld = std::max(result.unheld, deepest.depth);
    result.wait = std::max(result.wait, double(waiting));
    const double energy = pile.energy();
    least = std::min(least, energy);
    result.rise = std::max(result.rise, (energy - least) / start);
    if (!std::isfinite(energy)) break;
  }
  result.insane = pile.countInsane();
  result.lost = pile.countLost();
  return result;
}

Figures figuresOf(const Fall& run) {
  return {run.insane,
          run.lost,
          100 * run.rise,
          run.missed,
          run.wait,
          100 * run.unheld / kSize,
          100 * run.depth / kSize,
          100 * run.lying / kSize};
}

// Rocks in each other that nothing moves: what the budgets alone do to the error.
double errorOf(std::uint64_t seed, const Operations& operations, int bodies, int passes, bool worst) {
  constexpr double kCloser = 0.55;
  Pile pile(rocks(1, kSize).front().body, kSize, {.bodies = bodies, .seed = seed});
  for (btRigidBody* body : pile.bodies()) {
    btTransform at = body->getWorldTransform();
    at.getOrigin() *= btScalar(kCloser);
    body->setCenterOfMassTransform(at);
  }
  auto& world = pile.world();
  if (operations && !world.dispatcher.setBudget({*operations, {}}).ok()) return NAN;
  for (int i = 0; i < passes; ++i) world.world.performDiscreteCollisionDetection();
  const bullet::StepStatistics& step = world.dispatcher.lastStep();
  return worst ? step.worstErrorFraction : step.meanErrorFraction;
}

// The greatest rise of the mean error from a budget to the next larger one, per cent of size.
double worstRise(int seeds, int bodies, int passes, bool worst) {
  const std::array<Operations, 8> budgets{0, 1, 10, 100, 1000, 10000, 100000, std::nullopt};
  double before = std::numeric_limits<double>::infinity(), rise = 0;
  for (const Operations& budget : budgets) {
    double sum = 0;
    for (int seed = 1; seed <= seeds; ++seed) sum += errorOf(std::uint64_t(seed), budget, bodies, passes, worst);
    rise = test::greatest(rise, sum / seeds - before);
    before = sum / seeds;
  }
  return 100 * rise;
}

// Per cent of the size: what certified errors are enclosed to, so two that are equal may differ by as much.
constexpr double kErrorResolution = 0.01;

// An answer counts until its bodies have moved by so many per cent of their size: as deep may be what was apart.
constexpr double kUnasked = 3;
// A sixth of a second: the list names a wait, and no limit.
constexpr double kMaxSteps = 10;

constexpr const char* kWhy =
    "On next to no operations rocks come to lie some per cent of their size in each other. A slab sinks by 3 % of its "
    "size before its pair is refined again, and gains energy without a budget too. The mean error counts pairs with "
    "contacts alone, which bodies in a wall have.";

// The bodies that fall, and their number.
struct Scene {
  const char* name;
  const CaseBodies& kinds;
  const test::Solid& solid;
  int bodies;
};

std::vector<Asked> askedOf(const std::string& name) {
  std::vector<Asked> asked{{"bodies that are not finite", 0, Bound::atMost, ""},
                           {"bodies lost", 0, Bound::atMost, ""},
                           {"energy gained after any loss", 1, Bound::atMost, "%"},
                           {"steps in which the deepest pair had no contact", 0, Bound::atMost, ""},
                           {"steps in a row in which it had none, the most", kMaxSteps, Bound::atMost, ""},
                           {"deepest it was without one", kUnasked, Bound::atMost, "% of size"},
                           {"deepest of all steps", 25, Bound::atMost, "% of size"},
                           {"deepest once they lie", kUnasked, Bound::atMost, "% of size"}};
  for (Asked& each : asked) each.name = name + ": " + each.name;
  return asked;
}

// All budgets, worst of all, beside Bullet's shapes, which have none.
std::vector<Measure> fallsOf(const Scene& scene, int seeds, int steps, std::span<const Operations> budgets) {
  const std::vector<Asked> asked = askedOf(scene.name);
  const ExactPile judge(scene.solid);
  std::vector<Figures> ours;
  std::vector<StockRun> stock;
  for (int seed = 1; seed <= seeds; ++seed) {
    const PileOptions options{.bodies = scene.bodies, .seed = std::uint64_t(seed)};
    for (const Operations& operations : budgets)
      ours.push_back(figuresOf(fall(scene.kinds[0].body, judge, options, steps, operations)));
    for (std::size_t i = 1; i < scene.kinds.size(); ++i) {
      const Figures figures = figuresOf(fall(scene.kinds[i].body, judge, options, steps, {}));
      if (seed == 1)
        stock.push_back({scene.kinds[i].name, figures});
      else
        stock[i - 1].figures = worstOf(asked, {stock[i - 1].figures, figures});
    }
  }
  return besideTheBest(asked, worstOf(asked, ours), stock);
}

Outcome runBudgetStarvation(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const int seeds = isWhole ? 5 : 1, steps = isWhole ? 600 : 180, bodies = isWhole ? 20 : 8;
  const std::vector<Operations> budgets = isWhole
                                              ? std::vector<Operations>{0, 1, 10, 100, 300, 1000, 3000, std::nullopt}
                                              : std::vector<Operations>{0, 1, 10, 100, 1000, std::nullopt};
  std::vector<Measure> measures;
  const Vec3d slab{0.69, 0.69, 0.2};
  const test::Solid slabSolid = test::cuboid(slab, 1);
  for (const Scene& scene : {Scene{"rocks", rocks(1, kSize), solidOfRock(1, kSize), bodies},
                             Scene{"three slabs", boxes(slab), slabSolid, 3}})
    for (Measure& measure : fallsOf(scene, seeds, steps, budgets)) measures.push_back(std::move(measure));
  const int piles = isWhole ? 50 : 10;
  for (const int passes : {1, 10})
    for (const bool worst : {false, true})
      measures.push_back({std::string(worst ? "worst" : "mean") + " error, rise with the budget, " +
                              (passes == 1 ? "first step" : "tenth step"),
                          worstRise(piles, bodies, passes, worst), kErrorResolution, Bound::atMost, "% of size", "",
                          0});
  return {measures, kWhy};
}

}  // namespace

HardCase budgetStarvation() {
  return {"D16", "next to no budget",
          "a fall of twenty rocks, and of three slabs, on 0, 1, 10, 100, 300, 1000, 3000 and all operations a step: no "
          "NaN, nobody lost, energy never rises by more than 1 %, the deepest pair always answered, nothing that lies "
          "is deeper than an answer may wait; certified errors, means of 50 piles, never rise with the budget beyond "
          "what they are enclosed to (proposed list)",
          runBudgetStarvation};
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "compare.h"
#include "dynamics_cases.h"

// Structures that stand by friction and balance alone.
//
//        []              /\              .-##-.
//       [][]            /__\            ##    ##
//      [][][]          /\  /\          ##      ##
//     [][][][]        /  \/  \         ##      ##
//    pyramid         card house       arch
namespace cairn::hard {
namespace {

constexpr int kIterations = 100, kStepsPerSecond = 240;

/// Which body, where.
struct Piece {
  const CaseBodies* body;
  btTransform at;
};

btTransform at(double x, double z, double lean = 0) {
  return btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(lean)), btVector3(btScalar(x), 0, btScalar(z)));
}

// Rows of cubes, each of one fewer, half a cube apart at the sides.
std::vector<Piece> pyramid(const CaseBodies& cube, double margin) {
  constexpr int kRows = 5;
  constexpr double kGap = 0.02;
  std::vector<Piece> pieces;
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kRows - row; ++i)
      pieces.push_back(
          {&cube, at((i - 0.5 * (kRows - 1 - row)) * (1 + 2 * margin + kGap), 0.5 + row + margin * (2 * row + 1))});
  return pieces;
}

constexpr double kCard[3] = {0.05, 0.7, 1};  // thickness, depth, length

// Two cards against each other twice, a card across, two more on it.
std::vector<Piece> cardHouse(const CaseBodies& card, double margin, double degrees) {
  const double lean = degrees * std::numbers::pi / 180;
  const double thick = kCard[0] + 2 * margin, length = kCard[2] + 2 * margin;
  // A leaning card stands on one edge and touches the other card with another.
  const double height = length / 2 * std::cos(lean) + thick / 2 * std::sin(lean);
  const double away = length / 2 * std::sin(lean) + thick / 2 * std::cos(lean), pitch = 4 * away;
  std::vector<Piece> pieces;
  const auto tent = [&](double x, double z) {
    pieces.push_back({&card, at(x - away, z + height, lean)});
    pieces.push_back({&card, at(x + away, z + height, -lean)});
  };
  tent(-pitch / 2, 0);
  tent(pitch / 2, 0);
  pieces.push_back({&card, at(0, 2 * height + thick / 2, std::numbers::pi / 2)});
  tent(0, 2 * height + thick);
  return pieces;
}

constexpr int kStones = 9;
constexpr double kInner = 1, kOuter = 1.4, kRingDeep = 0.5;

// A wedge of a ring about y, standing in the middle of its own arc; its origin is its centre of mass.
test::Solid voussoir() {
  const double half = std::numbers::pi / kStones / 2;
  test::detail::SolidWriter out;
  Vec3d corner[8];
  for (int i = 0; i < 8; ++i) {
    const double r = i & 2 ? kOuter : kInner, angle = i & 1 ? half : -half;
    corner[i] = {r * std::sin(angle), i & 4 ? kRingDeep / 2 : -kRingDeep / 2, r * std::cos(angle)};
  }
  const auto face = [&](int a, int b, int c, int d) {
    out.triangle(corner[a], corner[b], corner[c]);
    out.triangle(corner[a], corner[c], corner[d]);
  };
  face(0, 1, 3, 2);
  face(4, 6, 7, 5);
  face(0, 4, 5, 1);
  face(2, 3, 7, 6);
  face(0, 2, 6, 4);
  face(1, 5, 7, 3);
  test::Solid solid = out.solid;
  const MassProperties mass = test::massOf(solid);
  for (Vec3d& v : solid.vertices) v -= mass.centerOfMass;
  return solid;
}
std::vector<Piece> arch(const CaseBodies& stone, double margin) {
  std::vector<Piece> pieces;
  const double half = std::numbers::pi / kStones / 2;
  // The centroid of a trapezium on the chords; farther out where margins are to fit between.
  const double radius =
      2.0 / 3 * std::cos(half) * (kOuter * kOuter + kOuter * kInner + kInner * kInner) / (kOuter + kInner) +
      margin / std::sin(half);
  for (int i = 0; i < kStones; ++i) {
    const double angle = -std::numbers::pi / 2 + (2 * i + 1) * half;
    pieces.push_back({&stone, at(radius * std::sin(angle), radius * std::cos(angle), angle)});
  }
  return pieces;
}

struct Building {
  const CaseBodies& of;
  std::function<std::vector<Piece>(const CaseBodies&, double margin)> pieces;
  double friction, size;
};

// Seconds until some piece has gone by a quarter of its size.
double standing(const Building& building, const std::string& shape, double seconds, bool inTwoDirections) {
  const auto body = std::ranges::find(building.of, shape, &CaseBody::name);
  test::StillWorld w;
  w.world.getSolverInfo().m_numIterations = kIterations;
  if (inTwoDirections) w.resist(test::Resisted::both);
  w.addGround().setFriction(btScalar(building.friction));
  std::vector<btRigidBody*> bodies;
  std::vector<btVector3> places;
  for (const Piece& piece : building.pieces(building.of, double(body->body.margin))) {
    bodies.push_back(&w.addTried(body->body, piece.at, btScalar(building.friction)));
    places.push_back(piece.at.getOrigin());
  }
  const int steps = int(seconds * kStepsPerSecond);
  for (int i = 0; i < steps; ++i) {
    w.world.stepSimulation(btScalar(1.0 / kStepsPerSecond), 0);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const double way = double((bodies[k]->getWorldTransform().getOrigin() - places[k]).length());
      if (!(way < building.size / 4)) return double(i) / kStepsPerSecond;
    }
  }
  return seconds;
}

Outcome runBuiltToStand(Effort effort) {
  const double seconds = effort == Effort::whole ? 10 : 1.5;
  const CaseBodies &cube = cubes(1), &card = boxes({kCard[0], kCard[1], kCard[2]}),
                   &stone = bodiesOf("voussoir", voussoir(), "", nullptr);
  std::vector<double> leans{20};
  if (effort == Effort::whole) leans = {15, 20, 25};
  const auto house = [&](const std::string& shape, bool inTwoDirections) {
    double sum = 0;
    for (const double lean : leans) {
      const auto pieces = [&](const CaseBodies& of, double margin) { return cardHouse(of, margin, lean); };
      sum += standing({card, pieces, 0.9, 0.5}, shape, seconds, inTwoDirections);
    }
    return sum / double(leans.size());
  };
  const auto ofStones = [&](const std::string& shape, bool inTwoDirections) {
    if (std::ranges::find(stone, shape, &CaseBody::name) == stone.end())
      return std::numeric_limits<double>::quiet_NaN();
    return standing({stone, arch, 0.9, 0.4}, shape, seconds, inTwoDirections);
  };
  const std::vector<Asked> asked{{"a pyramid of 15 cubes stands", seconds, Bound::atLeast, "s"},
                                 {"a card house of 7 cards stands, mean", seconds, Bound::atLeast, "s"},
                                 {"an arch of 9 stones stands", seconds, Bound::atLeast, "s"},
                                 {"the card house, friction in two directions", seconds, Bound::atLeast, "s"},
                                 {"the arch, friction in two directions", seconds, Bound::atLeast, "s"}};
  return {compare(asked, card,
                  [&](const CaseBody& body) -> Figures {
                    const std::string& shape = body.name;
                    return {standing({cube, pyramid, 0.5, 1}, shape, seconds, false), house(shape, false),
                            ofStones(shape, false), house(shape, true), ofStones(shape, true)};
                  }),
          "Bullet's solver resists sliding along one direction only, and friction begins anew in every step: leaning "
          "bodies creep apart with every shape. With friction in two directions card house and arch stand."};
}

}  // namespace

HardCase builtToStand() {
  return {"D3", "pyramid, card house, arch",
          "each stands for 10 s at 240 Hz and 100 iterations, cards leaning by 15, 20 and 25 degrees, or as long as "
          "the best of Bullet's shapes (proposed list)",
          runBuiltToStand};
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pieces that fit, with a little play: what is right is known from the pieces alone.
#include "fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::bench {
namespace {

constexpr double kStill = 0.02;  // m/s that nobody may have without a force

double turnOf(const btTransform& from, const btTransform& to) {
  btQuaternion turn = to.getRotation() * from.getRotation().inverse();
  const btScalar angle = turn.getAngle();
  return std::min(double(angle), 2 * std::numbers::pi - double(angle));
}

FitResult peg(Pieces& pieces, FitShape shape, const char* block) {
  int in = 0;
  double pushed = 0;
  for (int start = 0; start < 6; ++start) {
    FitWorld world(pieces, shape);
    world.add(block, 0, 1, at(0, 0, 0));
    const double angle = start * std::numbers::pi / 3, off = 0.0004 * start, tilt = 0.3 / 5 * start;
    const btQuaternion turn(btVector3(btScalar(std::sin(angle + 1)), btScalar(std::cos(angle + 1)), 0),
                            btScalar(tilt * std::numbers::pi / 180));
    btRigidBody& peg = world.add("peg", 1, 0.1, at(off * std::cos(angle), off * std::sin(angle), 0.72, turn));
    bool isIn = false;
    for (int step = 0; step < 300 && !isIn; ++step) {
      world.step();
      const btVector3 v = peg.getLinearVelocity();
      pushed = std::max({pushed, double(std::hypot(v.x(), v.y())), double(v.z())});
      isIn = peg.getWorldTransform().getOrigin().z() < 0;
    }
    in += isIn;
  }
  return {std::string("peg, ") + block, in == 6 && pushed < 0.2,
          fmt::format("{} of 6 in, fastest aside {:.3f} m/s", in, pushed)};
}

FitResult pegTight(Pieces& pieces, FitShape shape) {
  return peg(pieces, shape, "holeblock");
}
FitResult pegLoose(Pieces& pieces, FitShape shape) {
  return peg(pieces, shape, "hole5");
}

FitResult jigsaw(Pieces& pieces, FitShape shape) {
  FitWorld world(pieces, shape);
  const double friction = std::sqrt(0.2);
  world.addShape(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), 0, friction, at(0, 0, 0));
  std::vector<btRigidBody*> row;
  for (int i = 0; i < 5; ++i) row.push_back(&world.add("jigsaw", 1, friction, at(i, 0, 0.1)));
  double fastest = 0;
  for (int step = 0; step < 60; ++step) {
    world.step();
    fastest = std::max(fastest, world.fastest());
  }
  double widest = 0;
  for (int step = 0; step < 120; ++step) {
    row.back()->activate();
    row.back()->setLinearVelocity(btVector3(btScalar(0.5), 0, 0));
    world.step();
    for (std::size_t i = 1; i < row.size(); ++i) {
      const btVector3 way = world.meshPlace(*row[i]).getOrigin() - world.meshPlace(*row[i - 1]).getOrigin();
      widest = std::max(widest, double(way.length()) - 1);
    }
  }
  return {"jigsaw", fastest < kStill && widest < 0.02,
          fmt::format("{:.3f} m/s without force, pulled {:.4f} m apart", fastest, widest)};
}

FitResult slider(Pieces& pieces, FitShape shape) {
  double worst = 0, aside = 0;
  std::string ways;
  for (const double up : {1.0, -1.0})
    for (const double friction : {0.0, 0.3}) {
      FitWorld world(pieces, shape);
      const double g = 10, tilt = 0.35;
      world.world.setGravity(btVector3(0, btScalar(-up * g * std::cos(tilt)), btScalar(g * std::sin(tilt))));
      world.add("trail", 0, 1, at(0, 0, 0));
      btRigidBody& slider = world.add("tslider", 1, friction, at(0, 0, -1.5));
      slider.setActivationState(DISABLE_DEACTIVATION);
      const double theory = g * (std::sin(tilt) - friction * std::cos(tilt)) * 1.2 * 1.2 / 2;
      for (int step = 0; step < 72; ++step) {
        world.step();
        const btVector3 p = world.meshPlace(slider).getOrigin();
        aside = std::max(aside, double(std::hypot(p.x(), p.y())));
      }
      const double way = double(world.meshPlace(slider).getOrigin().z()) + 1.5;
      worst = std::max(worst, std::abs(way - theory) / theory);
      ways += fmt::format("{}{:.3f}/{:.3f}", ways.empty() ? "" : ", ", way, theory);
    }
  return {"T-slot", worst < 0.1 && aside < 0.02, fmt::format("slid {} m, {:.4f} m aside", ways, aside)};
}

FitResult key(Pieces& pieces, FitShape shape) {
  FitWorld world(pieces, shape);
  world.add("lock", 0, 1, at(0, 0, 0));
  btRigidBody& key = world.add("key", 1, 0.1, at(0, 0, 0.75));
  const btTransform start = world.meshPlace(key);
  double aside = 0, turned = 0;
  for (int step = 0; step < 20; ++step) {
    world.step();
    const btTransform now = world.meshPlace(key);
    aside = std::max(aside, double(std::hypot(now.getOrigin().x(), now.getOrigin().y())));
    turned = std::max(turned, turnOf(start, now));
  }
  const double fell = 0.75 - double(world.meshPlace(key).getOrigin().z());
  return {"key", fell > 0.4 && aside < 0.01 && turned < 0.04,
          fmt::format("fell {:.3f} m of .556, {:.4f} m aside, turned {:.3f} rad", fell, aside, turned)};
}

struct Deepest : btCollisionWorld::ContactResultCallback {
  double distance = 1e9;

  btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    distance = std::min(distance, double(p.getDistance()));
    return 0;
  }
};

double distanceOf(FitWorld& world, btRigidBody& a, btRigidBody& b, double threshold) {
  Deepest deepest;
  deepest.m_closestDistanceThreshold = btScalar(threshold);
  world.world.contactPairTest(&a, &b, deepest);
  return deepest.distance;
}

FitResult distances(Pieces& pieces, FitShape shape) {
  double worst = 0;
  std::string where;
  for (const bool toSphere : {true, false})
    for (const double separation : {0.001, 0.01, 0.05, 0.2})
      for (const double threshold : {0.1, 0.3, 0.5, 0.7, 1.0}) {
        if (threshold < separation) continue;
        FitWorld world(pieces, shape);
        btRigidBody& link = world.add("link", 0, 1, at(0, 0, 0));
        // Straight above the middle of a side, whose highest line is at z = 0.06657.
        const double top = 0.0665739, y = 0.25;
        btRigidBody& other = toSphere ? world.addShape(std::make_shared<btSphereShape>(btScalar(0.1)), 1, 1,
                                                       at(0, y, top + separation + 0.1))
                                      : world.add("link", 1, 1, at(0, 0, 2 * top + separation));
        const double error = std::abs(distanceOf(world, link, other, threshold) - separation);
        if (error > worst)
          where = fmt::format("{} at {} within {}", toSphere ? "sphere" : "link", separation, threshold);
        worst = std::max(worst, error);
      }
  return {"distances", worst < 0.002, fmt::format("off by at most {:.4f} m ({})", worst, where)};
}

FitResult cavity(Pieces& pieces, FitShape shape) {
  double nearest = 1e9;
  std::string told;
  for (const auto& [block, clear] : {std::pair("holeblock", 0.002), std::pair("hole5", 0.01)}) {
    FitWorld world(pieces, shape);
    btRigidBody& outer = world.add(block, 0, 1, at(0, 0, 0));
    btRigidBody& peg = world.add("peg", 1, 0.1, at(0, 0, 0));
    const double distance = distanceOf(world, outer, peg, 0);
    if (distance < 1e8) nearest = std::min(nearest, distance - 0.9 * clear);
    told += fmt::format("{}{}", told.empty() ? "" : ", ", distance < 1e8 ? fmt::format("{:.4f}", distance) : "nothing");
  }
  return {"cavity", nearest >= 0, fmt::format("told {} m where .002 and .010 are clear", told)};
}

FitResult chain(Pieces& pieces, FitShape shape, double heavy) {
  FitWorld world(pieces, shape);
  std::vector<btRigidBody*> rings;
  for (int i = 0; i < 8; ++i) {
    // The rings stand upright, every other one turned by a right angle.
    const btQuaternion turn = btQuaternion(btVector3(0, 0, 1), btScalar(i % 2 * std::numbers::pi / 2)) *
                              btQuaternion(btVector3(1, 0, 0), btScalar(std::numbers::pi / 2));
    const double mass = i == 0 ? 0 : i == 7 ? heavy : 1;
    rings.push_back(&world.add("ring", mass, std::sqrt(0.5), at(0, 0, -0.539 * i, turn)));
  }
  for (int step = 0; step < 1200; ++step) world.step();
  double fastest = 0;
  bool holds = true, sleeps = true;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    fastest = std::max(fastest, double(rings[i]->getLinearVelocity().length()));
    const btVector3 way = world.meshPlace(*rings[i]).getOrigin() - world.meshPlace(*rings[i - 1]).getOrigin();
    holds = holds && double(way.length()) < 0.6;
    sleeps = sleeps && !rings[i]->isActive();
  }
  return {fmt::format("chain {:.0f}:1", heavy), holds && sleeps,
          fmt::format("{}, {:.3f} m/s, {}", holds ? "holds" : "pulled through", fastest, sleeps ? "asleep" : "awake")};
}

FitResult chainLight(Pieces& pieces, FitShape shape) {
  return chain(pieces, shape, 5);
}
FitResult chainHeavy(Pieces& pieces, FitShape shape) {
  return chain(pieces, shape, 20);
}

FitResult cup(Pieces& pieces, FitShape shape) {
  FitWorld world(pieces, shape);
  btRigidBody& cup = world.add("thincup", 0, 0.7, at(0, 0, 0));
  cup.setCollisionFlags(cup.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  cup.setActivationState(DISABLE_DEACTIVATION);
  std::vector<btRigidBody*> inside;
  for (int i = 0; i < 18; ++i) {
    const int layer = i / 3;
    const double angle = i % 3 * 2 * std::numbers::pi / 3 + layer;
    const btTransform place = at(0.18 * std::cos(angle), 0.18 * std::sin(angle), 0.15 + 0.28 * layer);
    if (i % 3 == 2)
      inside.push_back(&world.add("dumbbell", 1, 0.7, place, 0.2));
    else
      inside.push_back(&world.addShape(std::make_shared<btSphereShape>(btScalar(0.08)), 1, 0.7, place));
    inside.back()->setActivationState(DISABLE_DEACTIVATION);
  }
  // Nothing leaves over the rim: a lid above what falls in.
  world.addShape(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, -1), btScalar(-2.2)), 0, 0.5, at(0, 0, 0));
  const btTransform local = cup.getWorldTransform();
  int through = 0;
  std::vector<bool> isOut(inside.size(), false);
  for (int step = 0; step < 1200; ++step) {
    const double phase = 2 * std::numbers::pi * 1.5 * step / 60, radius = std::min(0.08, 0.08 * step / 60);
    btTransform place = local;
    place.getOrigin() += btVector3(btScalar(radius * std::cos(phase)), btScalar(radius * std::sin(phase)), 0);
    btTransform before = cup.getWorldTransform();
    cup.setInterpolationWorldTransform(before);
    cup.setLinearVelocity((place.getOrigin() - before.getOrigin()) * 60);
    cup.setInterpolationLinearVelocity(cup.getLinearVelocity());
    cup.setWorldTransform(place);
    world.step();
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const btVector3 p = inside[i]->getWorldTransform().getOrigin() - place.getOrigin() + local.getOrigin();
      const bool isBeside = p.z() < 0.9 && std::hypot(p.x(), p.y()) > 0.4 && p.z() > -3;
      const bool isBelow = p.z() < -0.1;
      const bool wasInside = !isOut[i];
      if (wasInside && (isBeside || isBelow)) {
        isOut[i] = true;
        through += 1;
      }
    }
  }
  return {"cup", through == 0, fmt::format("{} of 18 outside", through)};
}

}  // namespace

std::vector<Fit> fits() {
  return {{"peg1", pegTight},       {"peg5", pegLoose}, {"jigsaw", jigsaw},     {"tslot", slider},       {"key", key},
          {"distances", distances}, {"cavity", cavity}, {"chain5", chainLight}, {"chain20", chainHeavy}, {"cup", cup}};
}

}  // namespace cairn::bench

// SPDX-License-Identifier: Zlib
// A tree in a world that nobody was installed on: said once, and never where somebody is.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bullet_world.h"
#include "cairn/bullet/install.h"

namespace cairn::test::unserved_test {
namespace {

// The standard error of a program of its own, which is none of those that ran before.
class Unserved : public testing::Test {
 protected:
  Unserved() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

template <class World>
void fallTwice(World& w) {
  w.addGround();
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, 2));
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(5, 0, 2));
  w.step(60);
}

TEST_F(Unserved, ATreeThatFallsIsToldOnce) {
  const auto program = [] {
    BulletWorld<btCollisionDispatcher> w;
    fallTwice(w);
    std::_Exit(0);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0),
              "^cairn: a body with a sphere-tree moves in a world.*\\(said once\\)\n$");
}

TEST_F(Unserved, IsNotSaidWhereSomebodyServes) {
  const auto program = [] {
    BulletWorld<> w;
    fallTwice(w);
    BulletWorld<btCollisionDispatcher> stock;
    const auto cairn = bullet::install(static_cast<btCollisionWorld&>(stock.world)).value();
    fallTwice(stock);
    std::_Exit(0);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
}

// A thousand rocks of one shape are placed, and then somebody is installed.
TEST_F(Unserved, IsNotSaidWhileBodiesArePlaced) {
  const auto program = [] {
    BulletWorld<btCollisionDispatcher> w;
    const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 3)));
    for (int i = 0; i < 1000; ++i)
      w.add(shape, 1, btVector3(btScalar(i % 10), btScalar(i / 10 % 10), btScalar(i / 100)));
    std::_Exit(0);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace cairn::test::unserved_test

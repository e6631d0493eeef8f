// SPDX-License-Identifier: GPL-3.0-or-later
// Where the textbook knows the answer: sphere-trees come as near to it as Bullet's own shapes of the same meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "textbook_shapes.h"

namespace cairn::test::textbook_test {
namespace {

// The limits for Bullet's own primitives, as fractions: the gates of the experiments' sources at 240 steps a second.
const std::map<std::string, double> kGates{{"R1", 1e-4},  {"R2", 0.02}, {"R3", 0.01},  {"R4", 0.02},
                                           {"R5", 0.005}, {"R6", 0.01}, {"R7", 0.02},  {"R8", 0.02},
                                           {"R9", 0.02},  {"R10", 0},   {"R11", 0.01}, {"R12", 1e-3}};

// A ball of 5120 flat faces is no ball: it loses energy from face to face, as its exact hull does. Beyond the hull's
// error and the gate, a tree may lose a fiftieth.
constexpr double kBeyondHull = 0.02;

TEST(Textbook, TreesKeepTheGatesOrTheHullsError) {
  const std::vector<TextbookShapes> all = textbookShapes();
  for (const auto& experiment : textbook::experiments()) {
    const TextbookResult stock = experiment(all.front()), hull = experiment(all[1]), tree = experiment(all.back());
    SCOPED_TRACE(stock.experiment + " " + stock.quantity);
    const double gate = kGates.at(stock.experiment);
    EXPECT_LE(stock.error(), gate);
    EXPECT_LE(tree.error(), std::max(gate, hull.error() + kBeyondHull)) << tree.measured << " for " << tree.exact;
  }
}

// Bodies with few faces are judged by these limits, whatever the spheres: the same for every depth.
TEST(Textbook, SlabsSlideTheSameWithTreesOfEveryDepth) {
  const std::vector<TextbookShapes> all = textbookShapes();
  for (const auto experiment : {textbook::slides, textbook::stops}) {
    const double deepest = experiment(all.back()).measured;
    for (std::size_t i = 2; i < all.size(); ++i) EXPECT_NEAR(experiment(all[i]).measured, deepest, 0.02 * deepest);
  }
}

}  // namespace
}  // namespace cairn::test::textbook_test

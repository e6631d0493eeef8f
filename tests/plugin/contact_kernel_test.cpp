// SPDX-License-Identifier: Zlib
// The contact kernel beside brute force: every feature of one mesh against every one of the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "every_target.h"
#include "kernel/contact_kernel.h"
#include "kernel_limits.h"
#include "random_tree.h"
#include "test_trees.h"

namespace cairn::test::contact_kernel_test {
namespace {

using namespace bullet;

constexpr unsigned kSeed = 23;

struct Bodies {
  std::shared_ptr<const SphereTree> a, b;
};

std::vector<Bodies> manyBodies() {
  const auto ring = plainTree(torus(0.3, 0.12, 16), 4), block = plainTree(cuboid({0.7, 0.5, 0.4}, 1), 2);
  const auto crate = plainTree(cuboid({0.5, 0.5, 0.5}, 4), 4), round = plainTree(ball(0.4, 8), 4);
  const auto dish = plainTree(bowl(0.5, 0.4, 20), 4);
  return {{ring, ring}, {ring, block}, {crate, crate}, {block, block}, {round, dish}, {dish, ring}, {crate, round}};
}

// Near enough to touch, as often apart as deep in each other.
Pose randomPose(std::mt19937_64& engine) {
  return {randomRotation(engine), normalized(randomPoint(engine)) * uniform(engine, 0.2, 0.8), 1};
}

FeatureLists edgesAlone(const SphereTree& a, const SphereTree& b) {
  const std::span<const SurfaceEdge> ofA = a.surface().features.edges(), ofB = b.surface().features.edges();
  FeatureLists lists;
  for (std::uint32_t i = 0; i < ofA.size(); ++i)
    for (std::uint32_t j = 0; j < ofB.size(); ++j)
      if (ofA[i].isConvex && ofB[j].isConvex) lists.edgesOnEdges.push_back({i, j, 0});
  return lists;
}

FeatureLists everything(const SphereTree& a, const SphereTree& b) {
  FeatureLists lists;
  const auto product = [](std::size_t ofA, std::size_t ofB, FeatureLists::List& list) {
    for (std::uint32_t i = 0; i < ofA; ++i)
      for (std::uint32_t j = 0; j < ofB; ++j) list.push_back({i, j, 0});
  };
  product(a.vertices().size(), b.triangles().size(), lists.verticesOnFaces);
  product(a.triangles().size(), b.vertices().size(), lists.facesOnVertices);
  const std::size_t edgesA = a.surface().features.edges().size(), edgesB = b.surface().features.edges().size();
  product(edgesA, b.triangles().size(), lists.edgesThroughFaces);
  product(a.triangles().size(), edgesB, lists.facesThroughEdges);
  lists.edgesOnEdges = edgesAlone(a, b).edgesOnEdges;
  return lists;
}

// The names of all contacts and crossings among what is listed.
struct Found {
  std::vector<std::array<std::uint32_t, 3>> contacts, crossings;

  bool operator==(const Found&) const = default;
};

Found found(const SurfacePair& surfaces, const FeatureLists& lists, const ContactLimits& limits = limitsOf(),
            float moved = 0) {
  PlacedPair placed;
  placed.begin(surfaces);
  std::vector<FeatureContact> contacts;
  FeatureContacts(surfaces, placed, limits).append(lists, moved, contacts);
  std::vector<Crossing> crossings;
  appendCrossings(surfaces, placed, lists, moved, crossings);
  Found result;
  for (const FeatureContact& c : contacts) result.contacts.push_back({std::uint32_t(c.kind), c.featureA, c.featureB});
  for (const Crossing& c : crossings) result.crossings.push_back({c.isEdgeOfA, c.edge, c.face});
  std::ranges::sort(result.contacts);
  std::ranges::sort(result.crossings);
  return result;
}

// And how far apart is what is not listed.
FeatureLists listed(const SurfacePair& surfaces, const ContactLimits& limits, float* apart = nullptr) {
  std::vector<PatchPair> near;
  FeatureLists lists;
  FeatureLister lister;
  lister.begin(surfaces, limits);
  Budget unlimited = Budget::unlimited();
  EXPECT_TRUE(lister.findNear(near, unlimited));
  EXPECT_TRUE(lister.list(near, 0, Asked::all, lists, unlimited));
  if (apart) *apart = near.empty() ? lister.minSeparation() : 0;
  return lists;
}

class KernelOnEveryTarget : public EveryTarget {};

TEST_F(KernelOnEveryTarget, ListsAllThatTouchesAndLittleElse) {
  std::size_t contacts = 0, crossings = 0;
  for (const Bodies& bodies : manyBodies()) {
    const FeatureLists all = everything(*bodies.a, *bodies.b);
    std::mt19937_64 engine(kSeed);
    std::size_t listedPairs = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const PlacedTree a(*bodies.a, randomPose(engine)), b(*bodies.b, Pose{randomRotation(engine), {}, 1});
      const SurfacePair surfaces = SurfacePair::of(a, b);
      const Found expected = found(surfaces, all);
      contacts += expected.contacts.size();
      crossings += expected.crossings.size();
      FeatureLists first;
      onEveryTarget([&] {
        const FeatureLists lists = listed(surfaces, limitsOf());
        EXPECT_EQ(found(surfaces, lists), expected) << "seed " << kSeed << ", trial " << trial;
        if (first.size() == 0) first = lists;
        EXPECT_EQ(lists.edgesOnEdges, first.edgesOnEdges) << "other bits, seed " << kSeed << ", trial " << trial;
        EXPECT_EQ(lists.size(), first.size()) << "other bits, seed " << kSeed << ", trial " << trial;
        listedPairs += lists.size();
      });
    }
    EXPECT_LT(listedPairs, 40 * all.size()) << "lists leave nothing out";
  }
  EXPECT_GT(contacts, 25U);
  EXPECT_GT(crossings, 1000U);
}

// Queries look farther than contacts reach: edges that face each other along no face's normal are listed too.
TEST(ContactKernel, ListsWhatAQueryAsksForFarAway) {
  const auto crate = plainTree(cuboid({1, 1, 1}, 16), 8);
  const FeatureLists all = edgesAlone(*crate, *crate);
  std::mt19937_64 engine(kSeed + 3);
  std::size_t contacts = 0;
  for (int trial = 0; trial < 12; ++trial) {
    // An edge of each across one of the other, along the diagonal between their faces.
    const double h = std::sqrt(0.5);
    const Mat3d onEdge{{Vec3d(h, 0, h), Vec3d(0, 1, 0), Vec3d(-h, 0, h)}};
    const double across = uniform(engine, 0.5, 1.5);
    const Mat3d turn{
        {Vec3d(std::cos(across), -std::sin(across), 0), Vec3d(std::sin(across), std::cos(across), 0), Vec3d(0, 0, 1)}};
    const double apart = uniform(engine, 0.02, 0.15);
    const PlacedTree b(*crate, Pose{onEdge, {}, 1});
    const PlacedTree a(*crate,
                       Pose{turn * onEdge, {uniform(engine, -0.2, 0.2), uniform(engine, -0.2, 0.2), 2 * h + apart}, 1});
    ContactLimits limits = limitsOf();
    limits.maxSeparation = 0.2F;
    const SurfacePair surfaces = SurfacePair::of(a, b);
    const Found expected = found(surfaces, all, limits);
    contacts += expected.contacts.size();
    FeatureLists edges;
    edges.edgesOnEdges = listed(surfaces, limits).edgesOnEdges;
    EXPECT_EQ(found(surfaces, edges, limits), expected) << "seed " << kSeed + 3 << ", trial " << trial;
  }
  EXPECT_GE(contacts, 12U);
}

// While no point has moved by more than the skin, what was listed is all that can touch, and what has a margin does not
// before they have moved by that.
TEST(ContactKernel, ListsWithASkinHoldUntilBodiesHaveMovedByIt) {
  constexpr float kSkin = 0.005F;
  std::size_t contacts = 0;
  for (const Bodies& bodies : manyBodies()) {
    std::mt19937_64 engine(kSeed + 1);
    for (int trial = 0; trial < 200; ++trial) {
      const Pose pose = randomPose(engine), still{randomRotation(engine), {}, 1};
      const PlacedTree a(*bodies.a, pose), b(*bodies.b, still);
      const FeatureLists lists = listed(SurfacePair::of(a, b), limitsOf(kSkin));
      for (int move = 0; move < 6; ++move) {
        // Half of the way by turning about any axis, half by shifting; the bodies reach no farther than 0.6.
        const double way = uniform(engine, 0, double(kSkin));
        const Vec3d axis = normalized(randomPoint(engine) + Vec3d(0, 0, 1e-3)) * (0.5 * way / 0.6);
        Pose moved = pose;
        Mat3d turn;
        turn.rows = {Vec3d(1, -axis.z, axis.y), Vec3d(axis.z, 1, -axis.x), Vec3d(-axis.y, axis.x, 1)};
        const Mat3d turned = turn * pose.rotation;
        const Vec3d x = normalized(turned.column(0)), z = normalized(cross(x, turned.column(1)));
        moved.rotation = transpose(Mat3d{{x, cross(z, x), z}});
        moved.translation += normalized(randomPoint(engine)) * (0.45 * way);
        const SurfacePair now = SurfacePair::of(PlacedTree(*bodies.a, moved), b);
        const Found expected = found(now, listed(now, limitsOf()));
        contacts += expected.contacts.size();
        EXPECT_EQ(found(now, lists, limitsOf(), float(way)), expected) << "seed " << kSeed + 1 << ", trial " << trial;
      }
    }
  }
  EXPECT_GT(contacts, 1000U);
}

// Pairs that boxes leave out are as far apart as the boxes say.
TEST(ContactKernel, SaysNoMoreOfWhatIsApartThanItIs) {
  std::mt19937_64 engine(kSeed + 2);
  int told = 0;
  const auto ring = plainTree(torus(0.3, 0.12, 16), 4);
  for (int trial = 0; trial < 200; ++trial) {
    const PlacedTree a(*ring,
                       Pose{randomRotation(engine), normalized(randomPoint(engine)) * uniform(engine, 0.7, 1.0), 1});
    const PlacedTree b(*ring, Pose{randomRotation(engine), {}, 1});
    const SurfacePair surfaces = SurfacePair::of(a, b);
    float apart = 0;
    listed(surfaces, limitsOf(), &apart);
    if (!(apart > 0)) continue;
    ++told;
    float nearest = 1e9F;
    for (const Vec3& v : ring->vertices())
      for (const Vec3& w : ring->vertices()) nearest = std::min(nearest, distance(a.toPair() * v, b.toPair() * w));
    EXPECT_LE(apart, nearest) << "seed " << kSeed + 2 << ", trial " << trial;
  }
  EXPECT_GT(told, 50);
}

// The overlap of two solids grows as A moves by as much as the vector area of A's surface inside B says.
TEST(ContactKernel, KnowsHowTheOverlapGrows) {
  const auto block = plainTree(cuboid({1, 1, 1}, 2), 4), peg = plainTree(cuboid({0.4, 0.3, 1}, 2), 4);
  // The peg stands 0.2 deep in the block's top: 0.4 by 0.3 of its end is inside, facing down.
  const PlacedTree a(*peg, Pose{Mat3d(), {0.03, 0.02, 0.8}, 1}), b(*block, Pose());
  const SurfacePair surfaces = SurfacePair::of(a, b);
  PlacedPair placed;
  placed.begin(surfaces);
  std::vector<Crossing> crossings;
  appendCrossings(surfaces, placed, listed(surfaces, limitsOf()), 0, crossings);
  OverlapRegions regions;
  Budget unlimited = Budget::unlimited();
  const auto answer = regions.find(surfaces, limitsOf(), {}, crossings, unlimited);
  ASSERT_TRUE(answer.has_value());
  const std::span<const OverlapRegion> found = *answer;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].area.z, -0.12, 1e-5);
  EXPECT_NEAR(found[0].area.x, 0, 1e-5);
  EXPECT_NEAR(found[0].area.y, 0, 1e-5);
  EXPECT_EQ(std::ranges::count(found[0].points, true, [](const OverlapPoint& p) { return p.isOfA && !p.isCrossing; }),
            9)
      << "the vertices of the peg's end";
}

// The depth of the deepest minimum among what is listed.
float deepestAmong(const SurfacePair& surfaces, const FeatureLists& lists, const ContactLimits& limits) {
  PlacedPair placed;
  placed.begin(surfaces);
  std::vector<FeatureContact> contacts;
  FeatureContacts(surfaces, placed, limits).append(lists, 0, contacts);
  float deepest = 0;
  for (const FeatureContact& c : contacts) deepest = std::max(deepest, -c.separation);
  return deepest;
}

// Deeper minima are looked for where surfaces cross alone; whatever is told is one that brute force finds.
TEST(ContactKernel, TellsMinimaAndNothingElse) {
  std::size_t shallow = 0, deeper = 0;
  for (const Bodies& bodies : manyBodies()) {
    const FeatureLists all = everything(*bodies.a, *bodies.b);
    std::mt19937_64 engine(kSeed + 4);
    ContactKernel kernel;
    for (int trial = 0; trial < 30; ++trial) {
      const PlacedTree a(*bodies.a, randomPose(engine)), b(*bodies.b, Pose{randomRotation(engine), {}, 1});
      const ContactLimits limits = limitsOf();
      ContactLimits tilted = limits;
      tilted.overlap = deepestAmong(SurfacePair::of(a, b), all, limits);
      const Found expected = found(SurfacePair::of(a, b), all, tilted);
      KernelMemory memory;
      Budget unlimited = Budget::unlimited();
      const auto answer = kernel.run(SurfacePair::of(a, b), limits, memory, {}, unlimited);
      ASSERT_TRUE(answer.has_value());
      for (const FeatureContact& c : answer->contacts) {
        if (isDeep(c.kind)) continue;
        (c.separation < -limits.contactDistance ? deeper : shallow) += 1;
        const std::array<std::uint32_t, 3> name{std::uint32_t(c.kind), c.featureA, c.featureB};
        EXPECT_TRUE(std::ranges::binary_search(expected.contacts, name)) << "seed " << kSeed + 4 << ", trial " << trial;
      }
    }
  }
  EXPECT_GT(shallow, 0U);
  EXPECT_GT(deeper, 20U);
}

// Of bodies wrapped around each other the line of their middles says where to; it may be too short to be squared.
TEST(ContactKernel, TellsDirectionsOfMiddlesThatAllButCoincide) {
  std::size_t deep = 0;
  for (const Bodies& bodies : manyBodies()) {
    std::mt19937_64 engine(kSeed + 5);
    ContactKernel kernel;
    for (int trial = 0; trial < 45; ++trial) {
      const Vec3d middle = randomPoint(engine) * std::pow(10.0, -trial);
      const PlacedTree a(*bodies.a, Pose{randomRotation(engine), middle, 1}), b(*bodies.b, Pose());
      KernelMemory memory;
      Budget unlimited = Budget::unlimited();
      const auto answer = kernel.run(SurfacePair::of(a, b), limitsOf(), memory, {}, unlimited);
      ASSERT_TRUE(answer.has_value());
      for (const FeatureContact& c : answer->contacts) {
        deep += isDeep(c.kind);
        EXPECT_NEAR(length(c.normal), 1, 1e-5) << "seed " << kSeed + 5 << ", trial " << trial;
        EXPECT_TRUE(isFinite(c.position) && std::isfinite(c.separation)) << "seed " << kSeed + 5;
      }
    }
  }
  EXPECT_GT(deep, 100U);
}

// Bodies that creep are not listed anew in each step; features, which have the narrower skin, more often than patches.
TEST(ContactKernel, ListsLastForSomeSteps) {
  const auto ring = plainTree(torus(0.3, 0.12, 16), 4);
  const PlacedTree b(*ring, Pose());
  ContactKernel kernel;
  KernelMemory memory;
  std::vector<std::uint64_t> used;
  for (int step = 0; step < 60; ++step) {
    const double moved = 4e-4 * step;
    bullet::RelativePlacement placement;
    placement.treeInOther.setOrigin(btVector3(btScalar(moved), 0, 0));
    placement.radius = btScalar(0.5);
    Budget budget = Budget::operations(1000000);
    ASSERT_TRUE(kernel.run(SurfacePair::of(PlacedTree(*ring, Pose{Mat3d(), {0.25 + moved, 0, 0.238}, 1}), b),
                           limitsOf(0.006F), memory, placement, budget));
    used.push_back(budget.used());
  }
  const std::uint64_t least = *std::ranges::min_element(used);
  const auto listed = std::ranges::count_if(used, [&](std::uint64_t u) { return u > 3 * least; });
  EXPECT_GE(listed, 6) << "with a skin three steps wide";
  EXPECT_LE(listed, 25);
}

// A pair that rests keeps nothing of a fast step with much to list.
TEST(ContactKernel, KeepsListsInLittleMoreThanTheyNeed) {
  FeatureLists many, few;
  many.edgesOnEdges.resize(5000);
  many.facesThroughEdges.resize(5000);
  few.verticesOnFaces.resize(7);
  few.edgesOnEdges.resize(3);
  CachedFeatures kept;
  kept.keep(many);
  EXPECT_EQ(kept.spans().edgesOnEdges.size() + kept.spans().facesThroughEdges.size(), 10000U);
  EXPECT_LE(kept.room(), 12500U);
  kept.keep(few);
  EXPECT_EQ(kept.spans().verticesOnFaces.size(), 7U);
  EXPECT_EQ(kept.spans().edgesOnEdges.size(), 3U);
  kept.shrinkToFit();
  EXPECT_EQ(kept.room(), 10U);
}

// A pair that rests gives memory back; what it knows stays.
TEST(ContactKernel, SaysTheSameInMemoryThatFits) {
  const auto ring = plainTree(torus(0.3, 0.12, 16), 4);
  const PlacedTree b(*ring, Pose());
  ContactKernel kernel;
  KernelMemory memory, fitted;
  std::size_t contacts = 0;
  for (int step = 0; step < 60; ++step) {
    const double moved = 4e-4 * step;
    bullet::RelativePlacement placement;
    placement.treeInOther.setOrigin(btVector3(btScalar(moved), 0, 0));
    placement.radius = btScalar(0.5);
    const PlacedTree a(*ring, Pose{Mat3d(), {0.25 + moved, 0, 0.238}, 1});
    const auto run = [&](KernelMemory& in) {
      Budget budget = Budget::operations(1000000);
      const auto answer = kernel.run(SurfacePair::of(a, b), limitsOf(0.006F), in, placement, budget);
      std::vector<std::array<float, 4>> reported{{answer->minSeparation, float(budget.used()), 0, 0}};
      for (const FeatureContact& c : answer->contacts)
        reported.push_back({c.separation, c.position.x, c.position.y, c.position.z});
      return reported;
    };
    const auto reported = run(memory);
    fitted.shrinkToFit();
    EXPECT_EQ(run(fitted), reported) << "step " << step;
    EXPECT_EQ(fitted.expectedCost(placement), memory.expectedCost(placement));
    contacts += reported.size() - 1;
  }
  EXPECT_GT(contacts, 100U);
}

}  // namespace
}  // namespace cairn::test::contact_kernel_test

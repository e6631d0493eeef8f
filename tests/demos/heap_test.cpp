// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "cairn/bullet/sphere_tree_shape.h"
#include "scene_trees.h"
#include "scenes/heap/heap_report_json.h"
#include "scenes/heap/heap_run.h"
#include "shape_names.h"

namespace cairn::scenes::heap_test {
namespace {

constexpr ShapeKind kAllShapes[] = {ShapeKind::tree, ShapeKind::treeLeaves, ShapeKind::gimpact, ShapeKind::hull,
                                    ShapeKind::spheres};

HeapOptions heapOf(std::uint32_t bodies) {
  HeapOptions options;
  options.bodies = bodies;
  return options;
}

std::unique_ptr<Heap> makeHeap(ShapeKind shape, const HeapOptions& base = heapOf(10)) {
  HeapOptions options = base;
  options.world.shape = shape;
  auto heap = Heap::create(makeModel(test::smallRockTree(), 1.0), options);
  EXPECT_TRUE(heap) << heap.error().message;
  return std::move(heap).value();
}

HeapReport run(Heap& heap, std::uint32_t steps) {
  auto report = runHeap(heap, steps);
  EXPECT_TRUE(report) << report.error().message;
  return std::move(report).value();
}

TEST(Heap_AtTheStart, NoTwoBodiesTouchAndAllAreInThePit) {
  const auto heap = makeHeap(ShapeKind::hull, heapOf(100));
  const auto bodies = heap->world().bodies();
  ASSERT_EQ(bodies.size(), 100U);
  const auto center = [](const btRigidBody* body) { return fromBullet(body->getWorldTransform().getOrigin()); };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      EXPECT_GT(distance(center(bodies[i]), center(bodies[j])), 2 * heap->model().reach);
    for (const HalfSpace& face : heap->pit().faces())
      EXPECT_GT(dot(face.normal, center(bodies[i])) - face.offset, heap->model().reach);
  }
}

TEST(Heap_EveryShape, HasTheSameMassFrameAndStart) {
  const auto reference = makeHeap(ShapeKind::hull);
  for (const ShapeKind kind : kAllShapes) {
    const auto heap = makeHeap(kind);
    for (std::size_t i = 0; i < heap->world().bodies().size(); ++i) {
      const btRigidBody &body = *heap->world().bodies()[i], &other = *reference->world().bodies()[i];
      EXPECT_EQ(body.getInvInertiaDiagLocal(), other.getInvInertiaDiagLocal()) << shapeName(kind);
      EXPECT_TRUE(body.getWorldTransform() == other.getWorldTransform()) << shapeName(kind);
    }
  }
}

TEST(Heap_Model, IsWhereTheTreeShapePutsItsMesh) {
  const Model model = makeModel(test::smallRockTree(), 1.0);
  const auto shape =
      bullet::SphereTreeShape::create(model.tree, bullet::BodyFrame::principalAxes, btScalar(model.scale));
  ASSERT_TRUE(shape);
  const bullet::SphereTreeShape& tree = *shape.value();
  // A few roundings of the scalar on lengths below 1.
  const double tolerance = 8 * std::numeric_limits<float>::epsilon();
  EXPECT_NEAR(tree.size(), 1, tolerance);
  for (std::size_t i = 0; i < model.vertices.size(); i += 7) {
    const btVector3 p = tree.bodyFromTree() * (toBullet(Vec3d(model.tree->vertices()[i])) * tree.scale());
    EXPECT_NEAR(distance(fromBullet(p), model.vertices[i]), 0, tolerance);
  }
  btVector3 inertia;
  tree.calculateLocalInertia(1, inertia);
  EXPECT_NEAR((inertia - model.inertia).length(), 0, tolerance);
}

class HeapOfShape : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(HeapOfShape, SettlesInThePit) {
  auto heap = makeHeap(GetParam());
  const HeapReport report = run(*heap, 300);
  EXPECT_EQ(report.lost, 0U);
  EXPECT_GT(report.cost.contacts.max, 0);
  EXPECT_GT(report.end.pitGap.pairs, 0U) << "nothing rests on the ground";
  EXPECT_GT(report.peakSpeed, 2);
  // Metres fallen, at most: energy cannot come from nowhere.
  EXPECT_LT(report.peakSpeed, 12);
  EXPECT_LT(report.kineticEnergyEnd, 0.5);
  // Spheres of a coarse level are fat; the others must keep the meshes apart to a few per cent.
  EXPECT_LT(report.end.depth.max, 0.05);
  EXPECT_LT(report.end.pitDepth.max, 0.05);
  EXPECT_EQ(report.cost.tree.has_value(), isSphereTree(GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Heap, HeapOfShape, ::testing::ValuesIn(kAllShapes), test::shapeTestName);

TEST_P(HeapOfShape, PressesOnTheGroundWithItsWeightEvenAsleep) {
  auto heap = makeHeap(GetParam(), heapOf(1));
  const double weight = 9.81 / 60;  // of 1 kg over one step, N s
  const auto bodies = heap->world().bodies();
  for (int step = 0; step < 1200 && bodies[0]->isActive(); ++step) heap->step();
  ASSERT_FALSE(bodies[0]->isActive());
  heap->step();
  // The body still rocks a little when Bullet puts it to sleep, and ten solver iterations leave a residue.
  EXPECT_NEAR(heap->world().loads().between(World::staticNumber(0), 0), weight, 0.1 * weight);
  EXPECT_FALSE(heap->world().loads().isLoaded(World::staticNumber(2), 0)) << "the wall across the pit";
}

TEST(Heap_SameSeed, GivesTheSameBitsTwice) {
  HeapOptions options = heapOf(10);
  options.world.budget.operations = 3000;
  const auto hashOf = [&](std::uint64_t seed) {
    options.seed = seed;
    auto heap = makeHeap(ShapeKind::tree, options);
    return run(*heap, 60).stateHash;
  };
  const std::string first = hashOf(1);
  EXPECT_EQ(hashOf(1), first);
  EXPECT_NE(hashOf(2), first);
}

TEST(Heap_ASmallBudget, LeavesPairsUnresolvedAndSaysSo) {
  HeapOptions options = heapOf(10);
  options.world.budget.operations = 300;
  auto limited = makeHeap(ShapeKind::tree, options);
  const HeapReport report = run(*limited, 120);
  auto unlimited = makeHeap(ShapeKind::tree);
  const HeapReport reference = run(*unlimited, 120);
  EXPECT_GT(report.cost.tree->unresolvedPairFraction, 0);
  EXPECT_EQ(reference.cost.tree->unresolvedPairFraction, 0);
  EXPECT_LT(report.cost.tree->operations.max, reference.cost.tree->operations.max);
  EXPECT_EQ(report.lost, 0U);
}

TEST(Heap_HullMargin, IsTheGapUnderLoadTheCheckFinds) {
  HeapOptions options = heapOf(1);
  options.shape.marginFraction = 0.02;
  auto heap = makeHeap(ShapeKind::hull, options);
  const HeapReport report = run(*heap, 240);
  ASSERT_GT(report.end.pitGap.pairs, 0U);
  // Bullet lets a resting body sink by a fraction of its slop and solver residue.
  constexpr double kSolverSlack = 0.003;
  EXPECT_NEAR(report.end.pitGap.max, 0.02, kSolverSlack);
}

TEST(Heap_NegativeBudget, IsRefused) {
  HeapOptions options = heapOf(1);
  options.world.budget.operations = -1;
  const auto heap = Heap::create(makeModel(test::smallRockTree(), 1.0), options);
  ASSERT_FALSE(heap);
  EXPECT_FALSE(heap.error().message.empty());
}

TEST(Heap_Cancelled, SaysSo) {
  auto heap = makeHeap(ShapeKind::hull);
  const auto report = runHeap(*heap, 100, [](std::uint32_t done) { return done < 3; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, builder::kCancelled);
}

TEST(HeapReport_Json, HasEveryAgreedKeyForEveryShape) {
  for (const ShapeKind kind : {ShapeKind::tree, ShapeKind::hull}) {
    auto heap = makeHeap(kind);
    const auto json = toJson(run(*heap, 5));
    for (const char* key : {"narrow_phase_cpu_us", "step_cpu_us"})
      for (const char* quantile : {"median", "p99", "p999", "max"}) EXPECT_TRUE(json.at(key).at(quantile).is_number());
    for (const char* key : {"contacts", "manifolds"})
      for (const char* quantile : {"median", "max"}) EXPECT_TRUE(json.at(key).at(quantile).is_number());
    for (const char* key : {"penetration_end_fraction", "gap_end_fraction"})
      for (const char* value : {"mean", "max"}) EXPECT_TRUE(json.at(key).at(value).is_number());
    const bool isTree = kind == ShapeKind::tree;
    EXPECT_EQ(json.at("operations").at("median").is_number(), isTree);
    EXPECT_EQ(json.at("certified_error_fraction").at("max").is_number(), isTree);
    EXPECT_EQ(json.at("unresolved_pairs_fraction").is_number(), isTree);
    for (const char* key : {"peak_speed_m_per_s", "kinetic_energy_end_j_per_kg", "bodies_lost", "bodies_asleep"})
      EXPECT_TRUE(json.at(key).is_number()) << key;
    EXPECT_EQ(json.at("state_hash").get<std::string>().size(), 16U);
  }
}

}  // namespace
}  // namespace cairn::scenes::heap_test

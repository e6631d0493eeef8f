// SPDX-License-Identifier: Zlib
#include "cairn/bullet/tree_drawing.h"

#include <gtest/gtest.h>

#include <set>

#include "bullet_world.h"

namespace cairn::test::tree_drawing_test {
namespace {

using bullet::errorColor;
using bullet::kErrorColors;
using bullet::SphereTreeShape;
using bullet::TreeDrawing;

// Takes down what it is asked to draw.
class Recorder final : public btIDebugDraw {
 public:
  struct Ball {
    btVector3 center;
    btScalar radius;
    btVector3 color;
  };
  std::vector<Ball> balls;
  int lines = 0, triangles = 0, frames = 0;

  void drawSphere(btScalar radius, const btTransform& t, const btVector3& color) override {
    balls.push_back({t.getOrigin(), radius, color});
  }
  void drawTriangle(const btVector3&, const btVector3&, const btVector3&, const btVector3&, btScalar) override {
    ++triangles;
  }
  void drawLine(const btVector3&, const btVector3&, const btVector3&) override { ++lines; }
  void drawTransform(const btTransform&, btScalar) override { ++frames; }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int mode) override { mode_ = mode; }
  int getDebugMode() const override { return mode_; }

 private:
  int mode_ = DBG_DrawWireframe;
};

// A world that is only drawn.
struct DrawnWorld {
  btDefaultCollisionConfiguration configuration;
  bullet::Dispatcher<> dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  TreeDrawing<btCollisionWorld> world{&dispatcher, &broadphase, &configuration};
  Recorder recorder;
  std::vector<std::unique_ptr<btCollisionObject>> objects;

  DrawnWorld() { world.setDebugDrawer(&recorder); }
  ~DrawnWorld() {
    for (const auto& object : objects) world.removeCollisionObject(object.get());
  }
  btCollisionObject& add(btCollisionShape& shape, const btTransform& transform) {
    objects.push_back(std::make_unique<btCollisionObject>());
    objects.back()->setCollisionShape(&shape);
    objects.back()->setWorldTransform(transform);
    world.addCollisionObject(objects.back().get());
    return *objects.back();
  }
  Recorder drawn() {
    recorder = Recorder();
    world.debugDrawWorld();
    return recorder;
  }
};

const btTransform kPlace(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.7)), btVector3(3, -2, 5));

std::shared_ptr<SphereTreeShape> ring() {
  const auto shape = treeShape(plainTree(torus(1, 0.3, 16)), btScalar(1.5));
  shape->setMargin(btScalar(0.125));
  return shape;
}

void expectLevel(const Recorder& recorder, const SphereTreeShape& shape, const btTransform& transform,
                 std::uint32_t level) {
  const std::vector<NodeId> nodes = shape.tree().levelCut(level);
  ASSERT_EQ(recorder.balls.size(), nodes.size());
  const btScalar rounding = btScalar(1e-5);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3d inMesh = Vec3d(shape.tree().sphere(nodes[i]).center) + shape.tree().origin();
    const btVector3 center = transform * shape.bodyFromMesh() *
                             (btVector3(btScalar(inMesh.x), btScalar(inMesh.y), btScalar(inMesh.z)) * shape.scale());
    EXPECT_LT((recorder.balls[i].center - center).length(), rounding);
    EXPECT_NEAR(recorder.balls[i].radius,
                btScalar(shape.tree().sphere(nodes[i]).radius) * shape.scale() + shape.getMargin(), rounding);
    const double error = shape.tree().error(nodes[i]) * shape.scale() / shape.size();
    EXPECT_LT((recorder.balls[i].color - errorColor(error)).length(), rounding);
  }
}

TEST(TreeDrawing, DrawsTheSpheresOfALevelInsteadOfTriangles) {
  DrawnWorld w;
  const auto shape = ring();
  w.add(*shape, kPlace);
  const auto triangles = static_cast<int>(shape->tree().triangles().size());
  Recorder drawn = w.drawn();
  EXPECT_TRUE(drawn.balls.empty()) << "Bullet's triangles until a level is set";
  EXPECT_EQ(drawn.triangles, triangles);
  for (std::uint32_t level = 0; level <= shape->tree().depth() + 1; ++level) {
    w.world.setTreeLevel(level);
    drawn = w.drawn();
    expectLevel(drawn, *shape, kPlace, level);
    EXPECT_EQ(drawn.lines + drawn.triangles, 0);
  }
  w.world.setTreeLevel(std::nullopt);
  EXPECT_EQ(w.drawn().triangles, triangles);
}

TEST(TreeDrawing, DrawsAllElseAsEver) {
  DrawnWorld w;
  w.world.setTreeLevel(1);
  btBoxShape box(btVector3(1, 1, 1));
  const auto shape = ring();
  btCompoundShape compound;
  const btTransform inside(btQuaternion::getIdentity(), btVector3(0, 4, 0));
  compound.addChildShape(inside, shape.get());
  w.add(box, kPlace);
  w.add(compound, kPlace);
  const Recorder drawn = w.drawn();
  EXPECT_EQ(drawn.lines, 12) << "the box's edges";
  expectLevel(drawn, *shape, kPlace * inside, 1);
  w.recorder = Recorder();
  w.recorder.setDebugMode(btIDebugDraw::DBG_DrawWireframe | btIDebugDraw::DBG_DrawFrames);
  w.world.debugDrawWorld();
  EXPECT_EQ(w.recorder.frames, 3) << "box, compound and child";
}

TEST(TreeDrawing, WholeWorldsAreDrawnOnTop) {
  DrawnWorld w;
  const auto shape = ring();
  btCompoundShape compound;
  compound.addChildShape(btTransform::getIdentity(), shape.get());
  btCollisionObject& hidden = w.add(*shape, btTransform::getIdentity());
  hidden.setCollisionFlags(hidden.getCollisionFlags() | btCollisionObject::CF_DISABLE_VISUALIZE_OBJECT);
  w.add(compound, kPlace);
  bullet::drawTrees(w.world, 2);
  expectLevel(w.recorder, *shape, kPlace, 2);
  w.world.setDebugDrawer(nullptr);
  bullet::drawTrees(w.world, 2);
}

btVector3 stop(std::size_t i) {
  return {btScalar(kErrorColors[i][0]), btScalar(kErrorColors[i][1]), btScalar(kErrorColors[i][2])};
}

TEST(ErrorColor, IsTheLegends) {
  const double legend[] = {0.003, 0.0083, 0.023, 0.065, 0.18, 0.50};
  for (std::size_t i = 0; i < std::size(legend); ++i) {
    // The legend names two digits.
    EXPECT_NEAR(bullet::onErrorScale(legend[i]) * 5, double(i), 0.02) << legend[i];
    EXPECT_LT((errorColor(legend[i]) - stop(i)).length(), 0.01) << legend[i];
  }
  EXPECT_LT((errorColor(std::sqrt(0.003 * 0.5)) - (stop(2) + stop(3)) / 2).length(), 1e-5);
}

TEST(ErrorColor, EndsWhereTheScaleEnds) {
  for (const double little : {0.0, -1.0, 1e-9, 0.003}) EXPECT_EQ(errorColor(little), errorColor(0.003));
  for (const double much : {0.5, 2.0, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(errorColor(much), errorColor(0.5));
}

// A drawer that only knows lines gets Bullet's balls of lines.
TEST(TreeDrawing, ADrawerOfLinesGetsLines) {
  class Lines final : public btIDebugDraw {
   public:
    int lines = 0;
    void drawLine(const btVector3&, const btVector3&, const btVector3&) override { ++lines; }
    void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
    void reportErrorWarning(const char*) override {}
    void draw3dText(const btVector3&, const char*) override {}
    void setDebugMode(int) override {}
    int getDebugMode() const override { return DBG_DrawWireframe; }
  } drawer;
  const auto shape = ring();
  bullet::drawTree(drawer, kPlace, *shape, 0);
  EXPECT_GT(drawer.lines, 100);
  EXPECT_LT(drawer.lines, 200);
}

}  // namespace
}  // namespace cairn::test::tree_drawing_test

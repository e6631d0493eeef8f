// SPDX-License-Identifier: Zlib
// btRaycastVehicle over ground that is a tree, beside the same drive over Bullet's own mesh shape: its wheels are rays,
// which hit the same triangles at the same fractions.
#include <gtest/gtest.h>

#include <BulletDynamics/Vehicle/btRaycastVehicle.h>

#include <cmath>

#include "bullet_world.h"
#include "casts.h"

namespace cairn::test::vehicle_test {
namespace {

// A slab of 60 by 12 metres, its upper side in waves of a few centimetres.
Solid waves() {
  Solid solid = cuboid({60, 12, 2}, 40);
  for (Vec3d& v : solid.vertices)
    if (v.z > 0.99) v.z += 0.04 * std::sin(1.3 * v.x) * std::cos(0.9 * v.y);
  return solid;
}

struct Drive {
  std::vector<btVector3> places;
  btScalar lowest = 9;
  int airborne = 0;  ///< steps in which some wheel touched nothing, after the first second
};

Drive drive(std::shared_ptr<btCollisionShape> ground) {
  BulletWorld<> w;
  w.add(std::move(ground), 0, btVector3(0, 0, -1));
  auto compound = std::make_shared<btCompoundShape>();
  btBoxShape box(btVector3(btScalar(1.2), btScalar(0.7), btScalar(0.2)));
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.4))), &box);
  btRigidBody& chassis = w.add(compound, 800, btVector3(-25, btScalar(0.037), btScalar(0.8)));
  chassis.setActivationState(DISABLE_DEACTIVATION);
  btDefaultVehicleRaycaster rays(&w.world);
  btRaycastVehicle::btVehicleTuning tuning;
  btRaycastVehicle vehicle(tuning, &chassis, &rays);
  vehicle.setCoordinateSystem(1, 2, 0);
  w.world.addVehicle(&vehicle);
  for (const bool isFront : {true, false})
    for (const btScalar side : {btScalar(-0.61), btScalar(0.61)}) {
      btWheelInfo& wheel = vehicle.addWheel(btVector3(isFront ? 1 : -1, side, btScalar(0.3)), btVector3(0, 0, -1),
                                            btVector3(0, -1, 0), btScalar(0.4), btScalar(0.35), tuning, isFront);
      wheel.m_suspensionStiffness = 30;
      wheel.m_wheelsDampingRelaxation = 3;
      wheel.m_wheelsDampingCompression = 4;
      wheel.m_frictionSlip = 3;
    }
  for (int i = 0; i < 2; ++i) vehicle.applyEngineForce(300, 2 + i);
  Drive result;
  for (int i = 0; i < 360; ++i) {
    w.step();
    result.places.push_back(chassis.getWorldTransform().getOrigin());
    result.lowest = std::min(result.lowest, result.places.back().z());
    for (int k = 0; i > 60 && k < 4; ++k)
      result.airborne += vehicle.getWheelInfo(k).m_raycastInfo.m_isInContact ? 0 : 1;
  }
  w.world.removeVehicle(&vehicle);
  return result;
}

TEST(Vehicle, DrivesOverATreeAsOverBulletsMeshShape) {
  const auto tree = treeShape(plainTree(waves(), 8));
  btTriangleMesh mesh;
  copyTriangles(*tree, mesh);
  const Drive ours = drive(tree), theirs = drive(std::make_shared<btBvhTriangleMeshShape>(&mesh, true));
  std::printf("drove %.2f m; wheels off the ground %d times\n",
              double((ours.places.back() - ours.places.front()).length()), ours.airborne);
  EXPECT_GT((ours.places.back() - ours.places.front()).length(), 5);
  EXPECT_GT(ours.lowest, 0.2);
  EXPECT_EQ(ours.airborne, theirs.airborne);
  btScalar apart = 0;
  for (std::size_t i = 0; i < ours.places.size(); ++i)
    apart = std::max(apart, (ours.places[i] - theirs.places[i]).length());
  EXPECT_LT(apart, 1e-3) << "of a wheel on an edge either of two triangles may be reported";
}

}  // namespace
}  // namespace cairn::test::vehicle_test

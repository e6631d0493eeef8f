// SPDX-License-Identifier: GPL-3.0-or-later
//
// The MJCF as MuJoCo itself loads it.
#include <mujoco/mujoco.h>

#include <memory>

#include "cairn/builder/robot.h"
#include "robot_run.h"

namespace cairn::builder::mujoco_test {
namespace {

using test::sharedRun;

std::string nameOf(const mjModel& model, mjtObj type, int id) {
  const char* const name = mj_id2name(&model, type, id);
  return name == nullptr ? "" : name;
}

struct Loaded {
  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::string error;

  explicit Loaded(const std::string& file) {
    char message[1000] = "";
    model.reset(mj_loadXML(file.c_str(), nullptr, message, sizeof message));
    error = message;
  }
};

TEST(Mujoco, LoadsTheRobot) {
  ASSERT_EQ(sharedRun().result.exitCode, 0) << sharedRun().result.errors;
  const Loaded loaded(sharedRun().out("mjcf"));
  ASSERT_TRUE(loaded.model) << loaded.error;
  const mjModel& m = *loaded.model;
  EXPECT_EQ(m.nbody, 7);  // and the world
  EXPECT_EQ(m.njnt, 4);
  EXPECT_EQ(m.neq, 1);
  EXPECT_EQ(m.ngeom, static_cast<int>(sharedRun().report.at("spheres").get<std::size_t>()));
  for (int g = 0; g < m.ngeom; ++g) EXPECT_EQ(m.geom_type[g], mjGEOM_SPHERE);
  const int left = mj_name2id(&m, mjOBJ_BODY, "left");
  EXPECT_DOUBLE_EQ(m.body_mass[left], 0.2);
  // The trace of the inertia does not depend on axes.
  const double* const inertia = m.body_inertia + 3 * left;
  EXPECT_NEAR(inertia[0] + inertia[1] + inertia[2], 0.0005, 1e-12);
}

TEST(Mujoco, PutsSpheresWhereTheUrdfHasThem) {
  ASSERT_EQ(sharedRun().result.exitCode, 0) << sharedRun().result.errors;
  const Loaded loaded(sharedRun().out("mjcf"));
  ASSERT_TRUE(loaded.model) << loaded.error;
  const mjModel& m = *loaded.model;
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&m), mj_deleteData);
  const RobotModel written = readUrdf(sharedRun().out("out.urdf")).value();
  const std::map<std::string, double> position{
      {"turn", 1.3}, {"slide", 0.2}, {"stay", 0}, {"spin", -2.1}, {"follow", -0.95}};
  std::vector<double> positions;
  for (const RobotJoint& joint : written.joints) {
    positions.push_back(position.at(joint.name));
    const int id = mj_name2id(&m, mjOBJ_JOINT, joint.name.c_str());
    if (joint.type == JointType::fixed) continue;
    ASSERT_GE(id, 0) << joint.name;
    data->qpos[m.jnt_qposadr[id]] = positions.back();
  }
  mj_kinematics(&m, data.get());
  const std::vector<RigidPose> poses = written.poses(positions);
  std::map<std::string, std::size_t> seen;
  for (int g = 0; g < m.ngeom; ++g) {
    const std::string body = nameOf(m, mjOBJ_BODY, m.geom_bodyid[g]);
    const auto link =
        std::find_if(written.links.begin(), written.links.end(), [&](const auto& l) { return l.name == body; });
    ASSERT_NE(link, written.links.end()) << body;
    const CollisionShape& sphere = link->collisions.at(seen[body]++);
    const Vec3d ours = poses[static_cast<std::size_t>(link - written.links.begin())](sphere.origin.translation);
    const double* const theirs = data->geom_xpos + 3 * g;
    EXPECT_NEAR(distance(ours, Vec3d{theirs[0], theirs[1], theirs[2]}), 0, 1e-12) << body;
    EXPECT_DOUBLE_EQ(m.geom_size[3 * g], sphere.size.x);
  }
}

TEST(Mujoco, HasRangesAndExclusions) {
  ASSERT_EQ(sharedRun().result.exitCode, 0) << sharedRun().result.errors;
  const Loaded loaded(sharedRun().out("mjcf"));
  ASSERT_TRUE(loaded.model) << loaded.error;
  const mjModel& m = *loaded.model;
  const int turn = mj_name2id(&m, mjOBJ_JOINT, "turn"), spin = mj_name2id(&m, mjOBJ_JOINT, "spin");
  EXPECT_DOUBLE_EQ(m.jnt_range[2 * turn], -2);
  EXPECT_DOUBLE_EQ(m.jnt_range[2 * turn + 1], 2.5);
  EXPECT_EQ(m.jnt_limited[spin], 0);
  EXPECT_DOUBLE_EQ(m.dof_damping[m.jnt_dofadr[turn]], 0.1);
  const auto always = sharedRun().report.at("self_collision").at("always").size();
  EXPECT_EQ(m.nexclude, static_cast<int>(5 + always));
}

}  // namespace
}  // namespace cairn::builder::mujoco_test

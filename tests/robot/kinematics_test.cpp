// SPDX-License-Identifier: GPL-3.0-or-later
//
// Poses of links, against urdfdom's own rotations.
#include <urdf_parser/urdf_parser.h>

#include <cmath>

#include "cairn/builder/robot.h"
#include "robot_run.h"

namespace cairn::builder::kinematics_test {
namespace {

// urdfdom's operators take vectors that are not const.
urdf::Vector3 throughJoint(const urdf::Joint& joint, double position, urdf::Vector3 p) {
  urdf::Vector3 a = joint.axis, offset = joint.parent_to_joint_origin_transform.position;
  const double norm = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  if (joint.type == urdf::Joint::PRISMATIC) {
    p = p + urdf::Vector3(a.x * position / norm, a.y * position / norm, a.z * position / norm);
  } else if (joint.type != urdf::Joint::FIXED) {
    const double s = std::sin(position / 2) / norm;
    p = urdf::Rotation(a.x * s, a.y * s, a.z * s, std::cos(position / 2)) * p;
  }
  urdf::Vector3 turned = joint.parent_to_joint_origin_transform.rotation * p;
  return turned + offset;
}

TEST(RobotPoses, AgreeWithUrdfdom) {
  const test::TemporaryFolder folder;
  const auto file = test::writeGeneratedRobot(folder.path());
  const RobotModel model = readUrdf(file).value();
  const urdf::ModelInterfaceSharedPtr judge = urdf::parseURDFFile(file.string());
  ASSERT_TRUE(judge);
  std::map<std::string, double> position{{"turn", 1.3}, {"slide", 0.2}, {"stay", 0}, {"spin", -2.1}};
  position["follow"] = 0.5 * position["spin"] + 0.1;
  std::vector<double> positions;
  for (const RobotJoint& joint : model.joints) positions.push_back(position.at(joint.name));
  const std::vector<RigidPose> poses = model.poses(positions);
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    urdf::Vector3 p(0.3, -0.2, 0.7);
    const Vec3d ours = poses[l]({p.x, p.y, p.z});
    for (auto link = judge->getLink(model.links[l].name); link->parent_joint; link = link->getParent())
      p = throughJoint(*link->parent_joint, position.at(link->parent_joint->name), p);
    EXPECT_NEAR(distance(ours, Vec3d{p.x, p.y, p.z}), 0, 1e-14) << model.links[l].name;
  }
}

}  // namespace
}  // namespace cairn::builder::kinematics_test

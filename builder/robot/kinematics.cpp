// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "robot/urdf_element.h"

namespace cairn::builder {
namespace {

RigidPose moved(const RobotJoint& joint, double position) {
  switch (joint.type) {
    case JointType::revolute:
    case JointType::continuous:
      return {rotationAbout(joint.axis, position), {}};
    case JointType::prismatic:
      return {{}, joint.axis * position};
    case JointType::fixed:
    case JointType::planar:
    case JointType::floating:
      break;
  }
  return {};
}

}  // namespace

bool RobotJoint::isActive() const {
  const bool moves = type == JointType::revolute || type == JointType::continuous || type == JointType::prismatic;
  return moves && !mimic;
}

double RobotModel::defaultPosition(std::uint32_t joint) const {
  return std::clamp(0.0, joints[joint].lower, joints[joint].upper);
}

std::vector<RigidPose> RobotModel::poses(const std::vector<double>& positions) const {
  std::vector<RigidPose> result(links.size());
  for (const std::uint32_t l : parentsFirst) {
    if (!links[l].joint) continue;
    const RobotJoint& joint = joints[*links[l].joint];
    const double position = joint.mimic ? joint.mimic->multiplier * positions[joint.mimic->joint] + joint.mimic->offset
                                        : positions[*links[l].joint];
    result[l] = result[joint.parent] * joint.origin * moved(joint, position);
  }
  return result;
}

}  // namespace cairn::builder

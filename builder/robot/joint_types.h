// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "cairn/builder/robot_model.h"

namespace cairn::builder {

/// The joint types of URDF by their names there.
inline constexpr std::array<std::pair<std::string_view, JointType>, 6> kJointTypes{
    {{"fixed", JointType::fixed},
     {"revolute", JointType::revolute},
     {"continuous", JointType::continuous},
     {"prismatic", JointType::prismatic},
     {"planar", JointType::planar},
     {"floating", JointType::floating}}};

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trajectory_log.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "cairn/core/atomic_file.h"

namespace cairn::rockfall {

TrajectoryLog::TrajectoryLog() : text_("time_s,rock,x_m,y_m,z_m,qx,qy,qz,qw,speed_m_per_s,spin_rad_per_s\n") {}

void TrajectoryLog::sample(double time, const scenes::World& world) {
  for (const btRigidBody* rock : world.bodies()) {
    const btVector3& p = rock->getWorldTransform().getOrigin();
    const btQuaternion q = rock->getWorldTransform().getRotation();
    fmt::format_to(std::back_inserter(text_),
                   "{:.3f},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f}\n", time,
                   rock->getUserIndex(), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(),
                   rock->getLinearVelocity().length(), rock->getAngularVelocity().length());
  }
}

Status TrajectoryLog::write(const std::filesystem::path& path) const {
  return writeFileAtomically(path, std::string_view(text_));
}

}  // namespace cairn::rockfall

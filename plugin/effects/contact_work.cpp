// SPDX-License-Identifier: Zlib
#include "contact_work.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include <cmath>

#include "surface_motion.h"

namespace cairn::effects {

bool wasAtWork(const Contact& contact) {
  const btManifoldPoint& point = *contact.point;
  return point.getAppliedImpulse() != 0 || point.m_appliedImpulseLateral1 != 0 || point.m_appliedImpulseLateral2 != 0;
}

ContactWork::ContactWork(const Contact& contact) {
  const btManifoldPoint& point = *contact.point;
  const btVector3 after = velocityAt(*contact.sides[0].object, point.getPositionWorldOnA()) -
                          velocityAt(*contact.sides[1].object, point.getPositionWorldOnB());
  const btVector3 middle = (contact.relativeVelocity + after) / 2;
  const btScalar normal = point.getAppliedImpulse();
  const btVector3 lateral = point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
                            point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2;
  across = {-double(normal * middle.dot(point.m_normalWorldOnB)), std::abs(double(normal)), 0};
  along = {-double(lateral.dot(middle)), double(lateral.length()), 0};
}

}  // namespace cairn::effects

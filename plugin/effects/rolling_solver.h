// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <cstddef>
#include <span>
#include <vector>

#include "rolling_row.h"

namespace cairn::effects {

/// Bullet's sequential solver with resistance to rolling and spinning that is proportional to the normal force,
/// whatever that is. Bullet's own rows end at the torque of a normal impulse of 1 N s. A rock of a tonne has
/// that in a tenth of a millisecond. Contacts that resist nothing it solves to the bit as the plain solver.
class RollingSolver : public btSequentialImpulseConstraintSolver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// For the next group: what `solver` would use, and what resists, ordered by point.
  void standInFor(btSequentialImpulseConstraintSolver& solver, std::span<Resistance> resistances);

 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int bodyCount, btPersistentManifold** manifolds,
                                        int manifoldCount, btTypedConstraint** constraints, int constraintCount,
                                        const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int bodyCount,
                                btPersistentManifold** manifolds, int manifoldCount, btTypedConstraint** constraints,
                                int constraintCount, const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int bodyCount,
                                         const btContactSolverInfo& info) override;

 private:
  // The body of this number in the solver, null if nothing moves it.
  const btRigidBody* bodyAt(int number) const { return m_tmpSolverBodyPool[number].m_originalBody; }

  struct Numbers {
    int contact, a, b;  // in the solver's pools
    std::size_t resistance;
  };

  std::span<Resistance> resistances_;
  std::vector<RollingRow> rows_;
  std::vector<Numbers> numbers_;  // beside the rows
};

}  // namespace cairn::effects

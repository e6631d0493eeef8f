// SPDX-License-Identifier: Zlib
#include "rolling_solver.h"

#include <algorithm>
#include <functional>

namespace cairn::effects {

void RollingSolver::standInFor(btSequentialImpulseConstraintSolver& solver, std::span<Resistance> resistances) {
  resistances_ = resistances;
  setRandSeed(solver.getRandSeed());
  setConstraintRowSolverGeneric(solver.getActiveConstraintRowSolverGeneric());
  setConstraintRowSolverLowerLimit(solver.getActiveConstraintRowSolverLowerLimit());
}

btScalar RollingSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int bodyCount,
                                                     btPersistentManifold** manifolds, int manifoldCount,
                                                     btTypedConstraint** constraints, int constraintCount,
                                                     const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar rest = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer);
  rows_.clear();
  numbers_.clear();
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    const btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
    const auto* point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    const auto found = std::ranges::lower_bound(resistances_, point, std::less<>{}, &Resistance::point);
    if (found == resistances_.end() || found->point != point) continue;
    rows_.emplace_back(*found, bodyAt(contact.m_solverBodyIdA), bodyAt(contact.m_solverBodyIdB));
    const auto resistance = static_cast<std::size_t>(found - resistances_.begin());
    numbers_.push_back({i, contact.m_solverBodyIdA, contact.m_solverBodyIdB, resistance});
  }
  return rest;
}

btScalar RollingSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int bodyCount,
                                             btPersistentManifold** manifolds, int manifoldCount,
                                             btTypedConstraint** constraints, int constraintCount,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) {
  // Before Bullet's own rows: these balance what the torques upset. After them, flat bodies creep down slopes.
  btScalar change = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto [contact, a, b, resistance] = numbers_[i];
    const btScalar normalImpulse = m_tmpSolverContactConstraintPool[contact].m_appliedImpulse;
    btSolverBody &bodyA = m_tmpSolverBodyPool[a], &bodyB = m_tmpSolverBodyPool[b];
    change = std::max(change, rows_[i].solve(bodyA, bodyB, normalImpulse));
  }
  const btScalar rest = btSequentialImpulseConstraintSolver::solveSingleIteration(
      iteration, bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer);
  return std::max(rest, change * change);
}

btScalar RollingSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int bodyCount,
                                                      const btContactSolverInfo& info) {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    resistances_[numbers_[i].resistance].work =
        rows_[i].work(m_tmpSolverBodyPool[numbers_[i].a], m_tmpSolverBodyPool[numbers_[i].b]);
  return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, bodyCount, info);
}

}  // namespace cairn::effects

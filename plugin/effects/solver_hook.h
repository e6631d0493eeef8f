// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btConstraintSolver.h>

namespace cairn::effects {

/// Who wants to know when a world is about to solve its contacts, and when it has.
class SolveListener {
 public:
  virtual ~SolveListener() = default;
  virtual void beforeSolve() = 0;
  virtual void afterSolve() = 0;
};

/// A solver that hands everything on to another one: the one place where a world of any dispatcher says, in every
/// internal step, that contacts are known and nothing has been done about them yet.
class SolverHook final : public btConstraintSolver {
 public:
  SolverHook(btConstraintSolver& solver, SolveListener& listener) : solver_(solver), listener_(listener) {}

  btConstraintSolver& solver() const { return solver_; }

  void prepareSolve(int bodies, int manifolds) override {
    listener_.beforeSolve();
    solver_.prepareSolve(bodies, manifolds);
  }
  btScalar solveGroup(btCollisionObject** bodies, int bodyCount, btPersistentManifold** manifolds, int manifoldCount,
                      btTypedConstraint** constraints, int constraintCount, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    return solver_.solveGroup(bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer,
                              dispatcher);
  }
  void allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) override {
    solver_.allSolved(info, drawer);
    listener_.afterSolve();
  }
  void reset() override { solver_.reset(); }
  btConstraintSolverType getSolverType() const override { return solver_.getSolverType(); }

 private:
  btConstraintSolver& solver_;
  SolveListener& listener_;
};

}  // namespace cairn::effects

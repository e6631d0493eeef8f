// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btConstraintSolver.h>

#include <memory>
#include <span>

#include "cairn/bullet/ordered_solver.h"
#include "platform/virtual_table.h"
#include "rolling_solver.h"

namespace cairn::effects {

/// Who wants to know when a world is about to solve its contacts, and when it has.
class SolveListener {
 public:
  virtual ~SolveListener() = default;
  virtual void beforeSolve() = 0;
  virtual void afterSolve() = 0;
};

/// A solver that hands everything on to another one: the one place where a world of any dispatcher says, in every
/// internal step, that contacts are known and nothing has been done about them yet. Steps in which something resists
/// rolling it gives to a solver of its own, which does what Bullet's plain one does and that besides.
class SolverHook final : public btConstraintSolver {
 public:
  SolverHook(btConstraintSolver& solver, SolveListener& listener)
      : solver_(solver), plain_(plainOf(solver)), listener_(listener) {}

  btConstraintSolver& solver() const { return solver_; }
  /// Whether the world's solver is one whose place the own one can take.
  bool canResist() const { return plain_ != nullptr; }
  /// From within `beforeSolve`, for the step that begins; ordered by point, and must live until `afterSolve`.
  void resist(std::span<Resistance> resistances) {
    resistances_ = canResist() ? resistances : std::span<Resistance>{};
    if (!resistances_.empty() && rolling_ == nullptr) rolling_ = ownSolver();
  }

  void prepareSolve(int bodies, int manifolds) override {
    listener_.beforeSolve();
    solver_.prepareSolve(bodies, manifolds);
  }
  btScalar solveGroup(btCollisionObject** bodies, int bodyCount, btPersistentManifold** manifolds, int manifoldCount,
                      btTypedConstraint** constraints, int constraintCount, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    if (resistances_.empty())
      return solver_.solveGroup(bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer,
                                dispatcher);
    rolling_->standInFor(*plain_, resistances_);
    const btScalar rest = rolling_->solveGroup(bodies, bodyCount, manifolds, manifoldCount, constraints,
                                               constraintCount, info, drawer, dispatcher);
    plain_->setRandSeed(rolling_->getRandSeed());
    return rest;
  }
  void allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) override {
    solver_.allSolved(info, drawer);
    listener_.afterSolve();
    resistances_ = {};
  }
  void reset() override { solver_.reset(); }
  btConstraintSolverType getSolverType() const override { return solver_.getSolverType(); }

 private:
  using Plain = btSequentialImpulseConstraintSolver;

  // Only of these very classes: another may do more than the own solver does.
  static Plain* plainOf(btConstraintSolver& solver) {
    static const bullet::VirtualTable plain = bullet::virtualTableOf(std::make_unique<Plain>().get());
    const bool isKnown = bullet::virtualTableOf(&solver) == plain || bullet::isOrderedSolver(&solver);
    return isKnown ? static_cast<Plain*>(&solver) : nullptr;
  }
  std::unique_ptr<RollingSolver> ownSolver() const {
    if (bullet::isOrderedSolver(&solver_)) return std::make_unique<bullet::OrderedSolver<RollingSolver>>();
    return std::make_unique<RollingSolver>();
  }

  btConstraintSolver& solver_;
  Plain* plain_;  // the plain solver, or null
  SolveListener& listener_;
  std::unique_ptr<RollingSolver> rolling_;  // once something resists
  std::span<Resistance> resistances_;       // of this step
};

}  // namespace cairn::effects

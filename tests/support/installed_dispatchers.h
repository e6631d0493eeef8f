// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "bullet_world.h"
#include "cairn/bullet/install.h"
#include "cairn/core/priority.h"

namespace cairn::test {

/// A stock dispatcher, nothing of it overridden, and the narrow phase installed beside it.
class StockDispatcher : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;

  Status setBudget(const bullet::StepBudget& budget) { return installed->setBudget(budget); }
  Status setFrameBudget(const bullet::StepBudget& budget) { return installed->setFrameBudget(budget); }
  void beginFrame(int steps) { installed->beginFrame(steps); }
  void setUnresolved(bullet::Unresolved policy) { installed->setUnresolved(policy); }
  void setFinest(bullet::Finest finest) { installed->setFinest(finest); }
  void setPriority(std::unique_ptr<Priority> priority) { installed->setPriority(std::move(priority)); }
  const bullet::StepStatistics& lastStep() const { return installed->lastStep(); }

  std::optional<bullet::NarrowPhase> installed;
};

struct InstalledOnDispatcher final : StockDispatcher {
  explicit InstalledOnDispatcher(btCollisionConfiguration* configuration) : StockDispatcher(configuration) {
    installed = bullet::install(static_cast<btCollisionDispatcher&>(*this)).value();
  }
};

struct InstalledOnWorld final : StockDispatcher {
  using StockDispatcher::StockDispatcher;
  void attach(btCollisionWorld& world) { installed = bullet::install(world).value(); }
  void detach() { installed.reset(); }
};

/// The ways in; for suites that have parameters of their own.
enum class FrontEnd { dispatcher, installedOnDispatcher, installedOnWorld };
inline constexpr FrontEnd kEveryFrontEnd[] = {FrontEnd::dispatcher, FrontEnd::installedOnDispatcher,
                                              FrontEnd::installedOnWorld};

/// Calls `test(world)` with a new `BulletWorld` behind that front end.
template <class Test>
void inWorldOf(FrontEnd frontEnd, const Test& test) {
  const auto run = [&]<class T>(std::type_identity<T>) {
    BulletWorld<T> w;
    test(w);
  };
  switch (frontEnd) {
    case FrontEnd::dispatcher:
      return run(std::type_identity<bullet::Dispatcher<>>());
    case FrontEnd::installedOnDispatcher:
      return run(std::type_identity<InstalledOnDispatcher>());
    case FrontEnd::installedOnWorld:
      return run(std::type_identity<InstalledOnWorld>());
  }
}

}  // namespace cairn::test

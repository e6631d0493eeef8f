// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "scenes/figures/cpu_clock.h"

class btOverlappingPairCache;
class btDispatcher;
struct btDispatcherInfo;

namespace cairn::scenes {

/// A dispatcher that measures its narrow phase in the same way for every shape: the thread CPU time of
/// `dispatchAllCollisionPairs`.
template <class Base>
class TimedDispatcher final : public Base {
 public:
  /// Adds the time of every dispatch to `microseconds`, which must outlive this object.
  template <class... Args>
  explicit TimedDispatcher(double& microseconds, Args&&... args)
      : Base(std::forward<Args>(args)...), microseconds_(microseconds) {}

  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    const double start = threadCpuMicroseconds();
    Base::dispatchAllCollisionPairs(pairs, info, dispatcher);
    microseconds_ += threadCpuMicroseconds() - start;
  }

 private:
  double& microseconds_;
};

}  // namespace cairn::scenes

// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

namespace cairn::bullet {

/// Data derived from Bullet's objects, shared by all callers while any of them keeps the pointer. Thread-safe.
///
///     static SharedFor<btConcaveShape, GroundSurface> known;
///     return known.of(shape, isStill, make);
template <class Object, class Derived>
class SharedFor {
 public:
  /// The data of the object: the existing one if `isStill(data)` holds, else the result of `make()`. Calls `make` under
  /// a lock. Cost: linear in the number of objects known.
  template <class IsStill, class Make>
  std::shared_ptr<const Derived> of(const Object& object, const IsStill& isStill, const Make& make) {
    const std::lock_guard lock(mutex_);
    std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<const Derived>& entry = known_[&object];
    std::shared_ptr<const Derived> derived = entry.lock();
    if (!derived || !isStill(*derived)) entry = derived = make();
    return derived;
  }

 private:
  std::mutex mutex_;
  std::map<const Object*, std::weak_ptr<const Derived>> known_;
};

}  // namespace cairn::bullet

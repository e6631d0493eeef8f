// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

namespace cairn::bullet {

/// What is derived of objects of Bullet's, shared by all who ask while anyone has it. Threads may ask at a time.
template <class Object, class Derived>
class SharedFor {
 public:
  /// That of the object, or where nobody has one for which `isStill(derived)` holds what `make()` makes.
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

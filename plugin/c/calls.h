// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <new>
#include <string>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/cairn.h"
#include "cairn/core/result.h"
#include "simulation/simulation.h"

// What C code holds.
struct CairnTree {
  std::shared_ptr<const cairn::SphereTree> tree;
};
struct CairnShape {
  std::shared_ptr<cairn::bullet::SphereTreeShape> shape;
};
struct CairnWorld {
  std::unique_ptr<cairn::simulation::Simulation> simulation;
};

namespace cairn::c {

/// The sentence of this thread's last failure.
inline std::string& lastError() {
  thread_local std::string error;
  return error;
}

inline constexpr const char* kNoMemory = "there is not enough memory; free trees and worlds that are not used";

/// Runs `call`, which returns a `Status`: 1, or 0 with a sentence left. No exception reaches C.
template <class Call>
int done(const Call& call) {
  try {
    const Status status = call();
    if (status) return 1;
    lastError() = status.error().message;
  } catch (const std::bad_alloc&) {
    lastError() = kNoMemory;
  }
  return 0;
}

/// An object for C to hold, made of the value of a `Result` that `call` returns; null with a sentence left.
template <class Object, class Call>
Object* made(const Call& call) {
  Object* object = nullptr;
  done([&]() -> Status {
    auto result = call();
    if (!result) return result.error();
    object = new Object{std::move(result).value()};
    return {};
  });
  return object;
}

}  // namespace cairn::c

// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

#include "calls.h"
#include "simulation/simulation.h"

namespace cairn::wasm {

/// What JavaScript holds of a world.
struct World {
  // Bullet cannot take down what is half built, so a broken world's memory is not given back.
  ~World() { isBroken ? void(simulation.release()) : simulation.reset(); }

  std::unique_ptr<simulation::Simulation> simulation;
  bool isBroken = false;  ///< a call was broken off half-way, so that Bullet's lists may not fit each other
};

inline Status whole(const World& world) {
  if (!world.isBroken) return {};
  return Error{"this world was broken off in a call for want of memory and cannot go on; load Cairn anew"};
}

inline constexpr std::size_t kRoomOfWorld = 13 << 18;  ///< of Bullet's pools, which leak where one is refused
// Of a call, several times what steps of heaps take. Only bodies that crowd in one place take more.
inline constexpr std::size_t kRoomOfCall = 1 << 20;
inline constexpr std::size_t kRoomOfBody = 1 << 14;

/// Throws where so many bytes are not to be had, before anything is begun that could be broken off for want of them.
inline void askForRoom(std::size_t bytes) {
  void* volatile trial = std::malloc(bytes);  // volatile, or compilers leave both calls out
  if (!trial) throw std::bad_alloc();
  std::free(trial);
}

/// Runs `call` on a world: 1, or 0 with a sentence left. A call that is broken off leaves a broken world.
template <class Call>
int changed(World* world, const Call& call, bool needsMemory = false) {
  return done([&]() -> Status {
    if (Status status = whole(*world); !status) return status;
    if (needsMemory) askForRoom(kRoomOfCall + kRoomOfBody * world->simulation->bodies().size());
    world->isBroken = true;
    Status status = call(*world->simulation);
    world->isBroken = false;
    return status;
  });
}

/// The same of a call that needs memory: where there is little, it is not begun, and the world stays as it is.
template <class Call>
int grown(World* world, const Call& call) {
  return changed(world, call, true);
}

/// A list of what is in a world, which `call` writes into `place`; null with a sentence left.
template <class T, class Call>
const T* read(const World* world, std::vector<T>& place, const Call& call) {
  return listed(place, [&]() -> Status {
    if (Status status = whole(*world); !status) return status;
    call(*world->simulation);
    return {};
  });
}

}  // namespace cairn::wasm

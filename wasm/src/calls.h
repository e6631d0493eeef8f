// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::wasm {

/// What a call leaves for JavaScript to pick up: the sentence of a failure, or a list of numbers.
struct Answer {
  std::string error;
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<std::uint32_t> integers;
  std::string text;
  std::size_t count = 0;  ///< elements in the list that was returned last
};

/// The one answer of this module, which runs in one thread.
inline Answer& answer() {
  static Answer instance;
  return instance;
}

/// Leaves a list and returns where it begins; valid until the next call that leaves one of its kind.
template <class T>
const T* leave(std::vector<T>& place, std::vector<T> list) {
  place = std::move(list);
  answer().count = place.size();
  return place.data();
}

/// Runs `call`, which returns a `Status`: 1, or 0 with a sentence left.
template <class Call>
int done(const Call& call) {
  try {
    const Status status = call();
    if (status) return 1;
    answer().error = status.error().message;
  } catch (const std::bad_alloc&) {
    answer().error = "there is not enough memory; free trees and worlds that are not used";
  }
  return 0;
}

/// An object for JavaScript to hold, from a `Result<Object>` that `call` returns: null with a sentence left.
template <class Object, class Call>
Object* made(const Call& call) {
  try {
    Result<Object> result = call();
    if (result) return new Object(std::move(result).value());
    answer().error = result.error().message;
  } catch (const std::bad_alloc&) {
    answer().error = "there is not enough memory; free trees and worlds that are not used";
  }
  return nullptr;
}

}  // namespace cairn::wasm

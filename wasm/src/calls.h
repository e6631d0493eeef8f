// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::wasm {

inline constexpr const char* kNoMemory = "there is not enough memory; free trees and worlds that are not used";

/// What a call leaves for JavaScript to pick up: the sentence of a failure, or a list of numbers.
struct Answer {
  Answer() { error.reserve(512); }  // so that want of memory can be told

  std::string error;
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<std::uint32_t> integers;
  std::vector<std::byte> bytes;
  std::size_t count = 0;  ///< elements of the list that was returned last
};

/// The one answer of this module, which runs in one thread.
inline Answer& answer() {
  static Answer instance;
  return instance;
}

/// Runs `call`, which returns a `Status`: 1, or 0 with a sentence left. No exception reaches JavaScript.
template <class Call>
int done(const Call& call) {
  try {
    const Status status = call();
    if (status) return 1;
    answer().error = status.error().message;
  } catch (const std::bad_alloc&) {
    answer().error = kNoMemory;
  } catch (const std::exception& exception) {
    answer().error = "Cairn failed inside: ";
    answer().error.append(exception.what(), std::min<std::size_t>(std::strlen(exception.what()), 200));
    answer().error += "; free this world or tree, and please report this flaw of Cairn's";
  }
  return 0;
}

/// An object for JavaScript to hold, of the value of a `Result` that `call` returns: null with a sentence left.
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

/// Fills `place` by `call`, which returns a `Status`. Returns where the list begins, valid until the next call that
/// leaves one there; null with a sentence left.
template <class T, class Call>
const T* listed(std::vector<T>& place, const Call& call) {
  static const T none{};  // an empty list lies somewhere, too
  answer().count = 0;
  place.clear();
  if (!done(call)) return nullptr;
  answer().count = place.size();
  return place.empty() ? &none : place.data();
}

}  // namespace cairn::wasm

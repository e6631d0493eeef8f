// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "cairn/core/export.h"

namespace cairn {

/// Why something was refused: one sentence that says what is wrong, where (file, line or element) and what to do.
struct Error {
  std::string message;  ///< for a user, without a final line break
};

/// Logs the sentence (`setLog`) and ends the program by `std::abort`, in every build type.
[[noreturn]] CAIRN_CORE_EXPORT void dieUnchecked(const char* what, const char* message);

/// A value, or the reason there is none. Used wherever data comes from outside; inside, preconditions are asserted.
template <class T>
class [[nodiscard]] Result {
 public:
  /// A value.
  Result(T value) : state_(std::move(value)) {}
  /// The reason there is none.
  Result(Error error) : state_(std::move(error)) {}

  /// Whether there is a value.
  bool ok() const { return state_.index() == 0; }
  /// The same as `ok()`.
  explicit operator bool() const { return ok(); }

  /// Ask `ok()` first: of an error, the error is printed and the program aborts, in every build type.
  T& value() & {
    requireValue();
    return *std::get_if<0>(&state_);
  }
  /// Precondition: `ok()`.
  const T& value() const& {
    requireValue();
    return *std::get_if<0>(&state_);
  }
  /// Precondition: `ok()`. The value moves out.
  T&& value() && {
    requireValue();
    return std::move(*std::get_if<0>(&state_));
  }

  /// Ask `ok()` first: of a value, the program aborts, in every build type.
  const Error& error() const {
    if (ok()) dieUnchecked("the error of a result was asked for that is none", "");
    return *std::get_if<1>(&state_);
  }

 private:
  void requireValue() const {
    if (!ok()) dieUnchecked("a result was used unchecked, and is an error: ", std::get_if<1>(&state_)->message.c_str());
  }

  std::variant<T, Error> state_;
};

/// Success, or the reason for failure.
class [[nodiscard]] Status {
 public:
  Status() = default;
  /// The reason for failure.
  Status(Error error) : error_(std::move(error)) {}

  /// Whether all went well.
  bool ok() const { return !error_; }
  /// The same as `ok()`.
  explicit operator bool() const { return ok(); }
  /// Ask `ok()` first: of a success, the program aborts, in every build type.
  const Error& error() const {
    if (ok()) dieUnchecked("the error of a status was asked for that is none", "");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace cairn

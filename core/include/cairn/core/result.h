// SPDX-License-Identifier: Zlib
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace cairn {

/// Why something was refused: one sentence that says what is wrong, where (file, line or element) and what to do.
struct Error {
  std::string message;  ///< for a user, without a final line break
};

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

  /// Precondition: `ok()`.
  T& value() & {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  /// Precondition: `ok()`.
  const T& value() const& {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  /// Precondition: `ok()`. The value moves out.
  T&& value() && {
    assert(ok());
    return std::move(*std::get_if<0>(&state_));
  }

  /// Precondition: `!ok()`.
  const Error& error() const {
    assert(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
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
  /// Precondition: `!ok()`.
  const Error& error() const {
    assert(!ok());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace cairn

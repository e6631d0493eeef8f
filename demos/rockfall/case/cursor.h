// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rockfall/case/document.h"

namespace cairn::rockfall {

/// The first thing found wrong with a case file. Reading goes on with defaults after it, so that readers need not ask
/// at every step; only the first complaint is kept, the others may follow from it.
class Complaint {
 public:
  explicit Complaint(std::string file) : file_(std::move(file)) {}
  void refuse(const std::string& path, std::string_view why);
  const std::optional<std::string>& first() const { return first_; }

 private:
  std::string file_;
  std::optional<std::string> first_;
};

/// Which numbers are allowed. No bound is infinite: what is beyond 1e12 in SI units is a slip of the keyboard.
struct Range {
  double low = -1e12, high = 1e12;
  bool aboveLow = false;  ///< `low` itself is not allowed
};
constexpr Range above(double low) {
  return {low, 1e12, true};
}
constexpr Range atLeast(double low) {
  return {low, 1e12, false};
}
constexpr Range between(double low, double high) {
  return {low, high, false};
}

/// A place in the document. Each reading checks kind and range; where it refuses, or where nothing stands, it returns a
/// harmless value.
class Value {
 public:
  Value(const Json* json, std::string path, Complaint& complaint)
      : json_(json), path_(std::move(path)), complaint_(&complaint) {}

  double number(const Range& range = {}) const;
  std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
  bool flag() const;
  /// Not empty.
  std::string text() const;
  /// Lower-case letters, digits, - and _, at most 64 of them, the first no sign: what may become part of a file's name.
  std::string name() const;
  /// Index of the one of `choices` that stands here; `what` names the kind of thing, as in "there is no effect ...".
  std::size_t choice(std::span<const std::string_view> choices, std::string_view what) const;
  /// The elements of an array of `least` to `most`.
  std::vector<Value> items(std::size_t least, std::size_t most) const;

  bool isObject() const { return json_ && json_->is_object(); }
  bool isArray() const { return json_ && json_->is_array(); }
  /// Where nothing stands, the object has a complaint of its own.
  void refuse(std::string_view why) const {
    if (json_) complaint_->refuse(path_, why);
  }

 private:
  friend class Object;
  const Json* json_;  // null where a key is missing; its object complains
  std::string path_;
  Complaint* complaint_;
};

/// An object being read: it notes which keys were asked for, and at its end refuses those nobody asked for, then those
/// asked for in vain. In that order, because a mistyped key is both.
class Object {
 public:
  explicit Object(const Value& value);
  ~Object();
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  /// A key that must be there.
  Value at(std::string_view key);
  /// A key that may be there.
  std::optional<Value> find(std::string_view key);
  double numberOr(std::string_view key, const Range& range, double otherwise);

  void refuse(std::string_view why) const { value_.refuse(why); }

 private:
  const Json* member(std::string_view key);
  void refuseUnknown(const std::string& key) const;

  Value value_;
  std::vector<std::string> asked_, missing_;
};

/// The one of `candidates` that is nearest to `word`, if it is near enough to have been meant.
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates);

}  // namespace cairn::rockfall

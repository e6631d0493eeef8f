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

/// The first error in a case file. After it, reading continues with defaults, so that readers need no check at every
/// step. Only the first error is kept, because later ones may follow from it.
class Complaint {
 public:
  explicit Complaint(std::string file) : file_(std::move(file)) {}
  void refuse(const std::string& path, std::string_view why);
  const std::optional<std::string>& first() const { return first_; }

 private:
  std::string file_;
  std::optional<std::string> first_;
};

/// The range of allowed numbers. No bound is infinite: a number above 1e12 in SI units is a typing error.
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

/// A value in the document. Each reader checks kind and range. If it refuses the value, or the value is missing, it
/// returns a harmless default.
///
///     Object object(value);
///     const double length = object.at("length_m").number(above(0));
class Value {
 public:
  Value(const Json* json, std::string path, Complaint& complaint)
      : json_(json), path_(std::move(path)), complaint_(&complaint) {}

  double number(const Range& range = {}) const;
  std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
  bool flag() const;
  /// Not empty.
  std::string text() const;
  /// A name: at most 64 lower-case letters, digits, - and _, the first no sign. It may become part of a file's name.
  std::string name() const;
  /// Returns the index of this value in `choices`. `what` names the kind of value in the error, as in "there is no
  /// effect ...".
  std::size_t choice(std::span<const std::string_view> choices, std::string_view what) const;
  /// Returns the elements of an array of `least` to `most` elements.
  std::vector<Value> items(std::size_t least, std::size_t most) const;

  /// Returns the keys of an object of at least one member and their values, in the order of the keys.
  std::vector<std::pair<std::string, Value>> members() const;

  /// Where it is in the document, as a JSON pointer.
  const std::string& path() const { return path_; }
  bool isNull() const { return json_ && json_->is_null(); }
  bool isObject() const { return json_ && json_->is_object(); }
  bool isArray() const { return json_ && json_->is_array(); }
  /// Reports an error at this value. For a missing value the object has reported its own error.
  void refuse(std::string_view why) const {
    if (json_) complaint_->refuse(path_, why);
  }

 private:
  friend class Object;
  const Json* json_;  // null for a missing key; its object reports that
  std::string path_;
  Complaint* complaint_;
};

/// Reads an object. It notes the requested keys. Its destructor refuses first the keys that no reader requested, then
/// the requested keys that are missing. A mistyped key is both, so this order names the mistyped key.
class Object {
 public:
  explicit Object(const Value& value);
  ~Object();
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  /// Returns the value of a required key.
  Value at(std::string_view key);
  /// Returns the value of an optional key.
  std::optional<Value> find(std::string_view key);
  double numberOr(std::string_view key, const Range& range, double otherwise);

  void refuse(std::string_view why) const { value_.refuse(why); }
  const std::string& path() const { return value_.path(); }

 private:
  const Json* member(std::string_view key);
  void refuseUnknown(const std::string& key) const;

  Value value_;
  std::vector<std::string> asked_, missing_;
};

/// Returns the candidate nearest to `word`, if it is near enough to be the intended one.
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates);

}  // namespace cairn::rockfall

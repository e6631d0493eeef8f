// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/cursor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::rockfall {
namespace {

/// Units at the end of a key; longer units stand before those they end with.
constexpr std::array<std::string_view, 15> kUnits{"_kg_per_m3", "_m_per_s2", "_rad_per_s", "_j_per_kg", "_m_per_s",
                                                  "_kg_per_s",  "_per_ha",   "_per_m",     "_per_s",    "_n_s",
                                                  "_kpa",       "_deg",      "_m",         "_s",        "_j"};

std::string_view withoutUnit(std::string_view key) {
  for (const std::string_view unit : kUnits)
    if (key.ends_with(unit)) return key.substr(0, key.size() - unit.size());
  return key;
}

/// Returns the key of `asked` that differs only in the unit or has none: level_cm for level_m.
std::optional<std::string> sameInOtherUnit(std::string_view key, std::span<const std::string> asked) {
  for (const std::string& candidate : asked) {
    const std::string_view stem = withoutUnit(candidate);
    const bool hasUnit = stem.size() < candidate.size();
    if (hasUnit && key.starts_with(stem) && (key.size() == stem.size() || key[stem.size()] == '_')) return candidate;
  }
  return {};
}

std::string describe(const Range& range) {
  if (range.high >= 1e12 && range.low > -1e12)
    return fmt::format("{} {}", range.aboveLow ? "above" : "at least", range.low);
  if (range.aboveLow) return fmt::format("above {} and at most {}", range.low, range.high);
  return fmt::format("from {} to {}", range.low, range.high);
}

/// Returns Levenshtein's distance.
std::size_t editsBetween(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string meant(const std::optional<std::string>& word) {
  return word ? fmt::format(" (did you mean \"{}\"?)", *word) : std::string();
}

bool isNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

}  // namespace

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates) {
  std::optional<std::string> nearest;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t edits = editsBetween(word, candidate); edits < fewest) {
      fewest = edits;
      nearest = candidate;
    }
  return nearest;
}

void Complaint::refuse(const std::string& path, std::string_view why) {
  if (!first_) first_ = inOneLine(fmt::format("{}: {}: {}", file_, path.empty() ? "(top)" : path, why));
}

double Value::number(const Range& range) const {
  if (!json_) return range.high;
  if (!json_->is_number()) {
    refuse("this must be a number");
    return range.high;
  }
  const double number = json_->get<double>();
  if (number >= range.low && number <= range.high && !(range.aboveLow && number == range.low)) return number;
  refuse(fmt::format("{} is out of range: this must be {}", number, describe(range)));
  return range.high;
}

std::uint64_t Value::whole(std::uint64_t low, std::uint64_t high) const {
  if (!json_) return low;
  const bool isWhole = json_->is_number_integer() ||
                       (json_->is_number_float() && json_->get<double>() == std::floor(json_->get<double>()));
  if (!isWhole) {
    refuse("this must be a whole number");
    return low;
  }
  const bool fits = json_->is_number_float() ? json_->get<double>() >= 0 && json_->get<double>() < 0x1p63
                                             : json_->is_number_unsigned() || json_->get<std::int64_t>() >= 0;
  const std::uint64_t number = !fits                      ? 0
                               : json_->is_number_float() ? static_cast<std::uint64_t>(json_->get<double>())
                                                          : json_->get<std::uint64_t>();
  if (fits && number >= low && number <= high) return number;
  refuse(fmt::format("{} is out of range: this must be from {} to {}", json_->dump(), low, high));
  return low;
}

bool Value::flag() const {
  if (!json_) return false;
  if (!json_->is_boolean()) refuse("this must be true or false");
  return json_->is_boolean() && json_->get<bool>();
}

std::string Value::text() const {
  if (!json_) return {};
  const bool isText = json_->is_string() && !json_->get<std::string>().empty();
  if (!isText) refuse("this must be a text that is not empty");
  return isText ? json_->get<std::string>() : std::string();
}

std::string Value::name() const {
  const std::string name = text();
  if (name.empty()) return name;
  const bool fits = name.size() <= 64 && name[0] != '-' && name[0] != '_' && std::ranges::all_of(name, isNameCharacter);
  if (!fits)
    refuse("a name is made of at most 64 lower-case letters, digits, - and _, and begins with a letter or digit");
  return name;
}

std::size_t Value::choice(std::span<const std::string_view> choices, std::string_view what) const {
  const std::string word = text();
  const auto found = std::ranges::find(choices, word);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const std::vector<std::string> words(choices.begin(), choices.end());
  if (!word.empty())
    refuse(fmt::format("there is no {} \"{}\"{}: use {}", what, word, meant(nearestWord(word, words)),
                       fmt::join(choices, ", ")));
  return 0;
}

std::vector<Value> Value::items(std::size_t least, std::size_t most) const {
  if (!json_) return {};
  std::vector<Value> items;
  if (!json_->is_array()) {
    refuse("this must be a list");
    return items;
  }
  if (json_->size() < least || json_->size() > most) {
    refuse(least == most ? fmt::format("this list must have {} elements", least)
           : json_->size() < least
               ? fmt::format("this list must have at least {} element{}", least, least == 1 ? "" : "s")
               : fmt::format("this list must have at most {} elements", most));
    return items;
  }
  for (std::size_t i = 0; i < json_->size(); ++i) items.emplace_back(&(*json_)[i], pathInto(path_, i), *complaint_);
  return items;
}

std::vector<std::pair<std::string, Value>> Value::members() const {
  std::vector<std::pair<std::string, Value>> members;
  if (!json_) return members;
  if (!json_->is_object() || json_->empty()) {
    refuse("this must be an object, as in { ... }, that is not empty");
    return members;
  }
  for (const auto& [key, member] : json_->items())
    members.emplace_back(key, Value(&member, pathInto(path_, key), *complaint_));
  return members;
}

Object::Object(const Value& value) : value_(value) {
  if (value_.json_ && !value_.json_->is_object()) {
    refuse("this must be an object, as in { ... }");
    value_.json_ = nullptr;
  }
}

Object::~Object() {
  if (!value_.json_) return;
  for (const auto& [key, member] : value_.json_->items())
    if (std::ranges::find(asked_, key) == asked_.end()) refuseUnknown(key);
  for (const std::string& key : missing_) refuse(fmt::format("\"{}\" is missing", key));
}

void Object::refuseUnknown(const std::string& key) const {
  const std::string path = pathInto(value_.path_, key);
  if (const auto other = sameInOtherUnit(key, asked_))
    return value_.complaint_->refuse(
        path, fmt::format("no such key here: give it as \"{}\", the unit is in the name", *other));
  value_.complaint_->refuse(path, "no such key here" + meant(nearestWord(key, asked_)));
}

const Json* Object::member(std::string_view key) {
  asked_.emplace_back(key);
  if (!value_.json_) return nullptr;
  const auto found = value_.json_->find(std::string(key));
  return found == value_.json_->end() ? nullptr : &*found;
}

Value Object::at(std::string_view key) {
  const Json* json = member(key);
  if (!json) missing_.emplace_back(key);
  return {json, pathInto(value_.path_, key), *value_.complaint_};
}

std::optional<Value> Object::find(std::string_view key) {
  const Json* json = member(key);
  if (!json) return {};
  return Value(json, pathInto(value_.path_, key), *value_.complaint_);
}

double Object::numberOr(std::string_view key, const Range& range, double otherwise) {
  const auto value = find(key);
  return value ? value->number(range) : otherwise;
}

}  // namespace cairn::rockfall

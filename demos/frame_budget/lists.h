// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"

namespace cairn::frame_budget {

/// Splits a text at its commas; an empty text gives one empty item.
std::vector<std::string> itemsOf(std::string_view text);

/// Reads a decimal number that takes up the whole text; nothing for any other text, such as "none".
template <class Number>
std::optional<Number> numberOf(std::string_view text) {
  Number value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

/// Returns a function for `CLI::Option::check`: the first item that `refuse` rejects decides.
std::function<std::string(const std::string&)> eachItem(std::function<std::string(const std::string&)> refuse);

/// The options that may be lists, as texts. All their combinations are measured.
struct ListTexts {
  std::string scenes = "heap", shapes = "tree", bodies, budgetOperations, budgetMicroseconds, marginFractions,
              maxContactErrors, methods = "combined", priorities = "round-robin", unresolved = "guard";
};

/// Returns the combinations of all items in the order scenes, bodies, methods, shapes, margins, contact errors,
/// budgets, priorities, policies. Each has one shape; `steps`, where given, is for all.
///
/// A shape is varied only in options that affect it. Budgets, priorities and policies affect only the sphere-tree,
/// methods the tree and its spheres, margins only GImpact, hulls and compounds. The shape `fcl` takes part only in
/// recorded poses. When every list but that of the shapes has one item, there is one combination with all shapes. Fails
/// in one sentence for an unknown item. Precondition: numbers were checked.
Result<std::vector<Options>> combinationsOf(const ListTexts& texts, const Options& base,
                                            const std::optional<std::uint32_t>& steps);

}  // namespace cairn::frame_budget
